// A cloth falls on a ball, folds on itself, and rests: a solver of one page that lives on contact points alone.
// Small steps of position-based dynamics (M. Macklin et al., Small Steps in Physics Simulation, SCA 2019): move, pull
// springs back, ask tact, keep apart what it names. Status 0: nothing ever crossed, and the cloth lies on the ball.
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr int kSide = 24;          // vertices along a side of the cloth
constexpr double kSpacing = 0.06;  // metres
constexpr double kRadius = 0.35;   // of the ball, metres
constexpr double kMargin = 0.005;  // of every body, metres; surfaces are kept apart by the sum of two
constexpr double kFriction = 0.4;
constexpr double kSubstep = 1.0 / 720.0;  // seconds: in one, nothing may move farther than two margins
constexpr int kSubsteps = 1800;

struct Body {
  Matrix3Xd now, before;  // positions, and those when the substep began
  Eigen::Matrix3Xi facets;
  bool moves;
};

// Vertices in rows, where place(column, row) says, and two facets a cell.
Body grid(int columns, int rows, bool moves, auto place) {
  Body body{Matrix3Xd(3, columns * rows), {}, Eigen::Matrix3Xi(3, 2 * (columns - 1) * (rows - 1)), moves};
  for (int v = 0; v < columns * rows; ++v) body.now.col(v) = place(v % columns, v / columns);
  for (int f = 0; f < body.facets.cols(); f += 2) {
    const int a = f / 2 + f / 2 / (columns - 1), c = a + columns;
    body.facets.col(f) << a, a + 1, c + 1;
    body.facets.col(f + 1) << a, c + 1, c;
  }
  body.before = body.now;
  return body;
}

// Halfway back to the distances at rest: to the neighbours, across diagonals, to the next but one against bending.
void pull_springs(Matrix3Xd& x, const Matrix3Xd& rest) {
  for (int a = 0; a < x.cols(); ++a)
    for (const auto [di, dj] : {std::array{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}}) {
      const int i = a % kSide + di, j = a / kSide + dj, b = j * kSide + i;
      if (i < 0 || i >= kSide || j >= kSide) continue;
      const Vector3d way = x.col(b) - x.col(a);
      const Vector3d half = 0.25 * (1.0 - (rest.col(b) - rest.col(a)).norm() / way.norm()) * way;
      x.col(a) += half;
      x.col(b) -= half;
    }
}

// One side of a contact point: a place that up to three vertices carry by their weights; -1 stands for none.
struct Carried {
  Body& body;
  const std::array<int, 3>& vertices;
  Vector3d weights;
  Vector3d at(const Matrix3Xd& x) const {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 3 && vertices[k] >= 0; ++k) sum += weights[k] * x.col(vertices[k]);
    return sum;
  }
  double give() const { return body.moves ? weights.squaredNorm() : 0.0; }  // by which a unit push moves it
  void move(const Vector3d& way) {
    for (int k = 0; body.moves && k < 3 && vertices[k] >= 0; ++k) body.now.col(vertices[k]) += weights[k] * way;
  }
};

// Moves the two places of a point apart to both margins, then takes back what they slid, by Coulomb's law.
void keep_apart(const tact::ContactPoint& p, Body& body_a, Body& body_b) {
  Carried a{body_a, p.a_vertices, Vector3d(p.a_weights.data())}, b{body_b, p.b_vertices, Vector3d(p.b_weights.data())};
  const Vector3d between = b.at(body_b.now) - a.at(body_a.now);
  const double both = a.give() + b.give(), missing = 2.0 * kMargin - p.normal.dot(between);
  if (both == 0.0 || missing <= 0.0) return;
  Vector3d slid = between - (b.at(body_b.before) - a.at(body_a.before));
  slid -= slid.dot(p.normal) * p.normal;
  const double held = std::min(1.0, kFriction * missing / std::max(slid.norm(), 1e-12));
  const Vector3d way = (missing * p.normal - held * slid) / both;
  a.move(-way);
  b.move(way);
}

int main() {
  Body cloth = grid(kSide, kSide, true, [](int i, int j) {
    return Vector3d(kSpacing * (i - 0.5 * (kSide - 1)) + 0.02, kSpacing * (j - 0.5 * (kSide - 1)),
                    kRadius + 0.03 + 0.001 * ((7 * i + 5 * j) % 3));
  });
  Body ball = grid(41, 21, false, [](int i, int j) {  // rolled up: its sides and ends meet, vertices may be repeated
    const double u = std::numbers::pi * (i % 40) / 20.0, v = std::numbers::pi * (j / 20.0 - 0.5);
    return Vector3d(kRadius * Vector3d(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)));
  });
  const Matrix3Xd rest = cloth.now;
  Matrix3Xd velocity = Matrix3Xd::Zero(3, rest.cols());
  tact::World world({.outputs = {.points = true}});
  const auto sheet = tact::Surface::sheet;
  const tact::BodyId id = world.add_body(
      {.positions = cloth.now, .facets = cloth.facets, .surface = sheet, .margin = kMargin, .self_contact = true});
  world.add_body({.positions = ball.now, .facets = ball.facets, .motion = tact::Motion::fixed, .margin = kMargin});
  std::size_t crossed = 0, points = 0;
  for (int substep = 0; substep < kSubsteps; ++substep) {
    cloth.before = cloth.now;
    velocity.row(2).array() -= 9.81 * kSubstep;
    cloth.now += kSubstep / (1.0 + 2.0 * kSubstep) * velocity;  // with drag
    pull_springs(cloth.now, rest);
    world.set_positions(id, cloth.now);
    points = 0;
    for (const tact::Contact& contact : world.detect().contacts()) {
      crossed += contact.facet_pairs().size();
      points += contact.points().size();
      for (const tact::ContactPoint& point : contact.points())
        keep_apart(point, contact.a == id ? cloth : ball, contact.b == id ? cloth : ball);
    }
    velocity = (cloth.now - cloth.before) / kSubstep;
  }
  const double top = cloth.now.row(2).maxCoeff(), speed = std::sqrt(velocity.colwise().squaredNorm().mean());
  std::printf("%zu points; facets that ever crossed: %zu; top at %.4f m, speed %.3f m/s\n", points, crossed, top,
              speed);
  return crossed == 0 && points > 60 && std::abs(top - kRadius - 2.0 * kMargin) < kMargin && speed < 0.5 ? 0 : 1;
}

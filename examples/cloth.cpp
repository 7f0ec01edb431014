// A cloth falls on a ball, folds on itself, and rests: a solver of one page that lives on contact points alone.
//
// Position-based dynamics with substeps (M. Mueller et al., Position Based Dynamics, VRIPhys 2006; M. Macklin et al.,
// Small Steps in Physics Simulation, SCA 2019): move, pull the springs back, ask tact, keep apart what it names. It
// ends with status 0 if nothing ever crossed and the cloth lies on the ball.
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr int kSide = 24;          // vertices along a side of the cloth
constexpr double kSpacing = 0.06;  // metres
constexpr double kRadius = 0.35;   // of the ball, metres
constexpr double kMargin = 0.005;  // half the thickness of every surface, metres
constexpr double kFriction = 0.4;
constexpr double kSubstep = 1.0 / 720.0;  // seconds: in one, nothing may move farther than two margins
constexpr int kSubsteps = 1800;

struct Spring {
  int a, b;
  double length;  // at rest, metres
};

// A body: where it is, where it was when the substep began, and whether contacts move it.
struct Body {
  tact::BodyId id;
  Matrix3Xd now, before;
  bool moves;
};

int at(int i, int j) { return j * kSide + i; }

Matrix3Xd cloth_positions() {
  Matrix3Xd x(3, kSide * kSide);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      x.col(at(i, j)) = kSpacing * Vector3d(i - 0.5 * (kSide - 1), j - 0.5 * (kSide - 1), 0.0) +
                        Vector3d(0.02, 0.0, kRadius + 0.03 + 0.001 * ((7 * i + 5 * j) % 3));
  return x;
}

Eigen::Matrix3Xi grid_facets(int columns, int rows) {
  Eigen::Matrix3Xi facets(3, 2 * (columns - 1) * (rows - 1));
  for (int j = 0, f = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i, f += 2) {
      const int a = j * columns + i;
      facets.col(f) << a, a + 1, a + columns + 1;
      facets.col(f + 1) << a, a + columns + 1, a + columns;
    }
  return facets;
}

// To the neighbours, across the diagonals, and to the next but one, which resists bending.
std::vector<Spring> cloth_springs(const Matrix3Xd& x) {
  std::vector<Spring> springs;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      for (const auto [di, dj] : {std::array{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}}) {
        if (i + di < 0 || i + di >= kSide || j + dj >= kSide) continue;
        const int a = at(i, j), b = at(i + di, j + dj);
        springs.push_back({a, b, (x.col(a) - x.col(b)).norm()});
      }
  return springs;
}

// A globe, rolled from a grid whose sides and ends meet: repeated vertices are allowed.
Matrix3Xd ball_positions(int around, int rings) {
  Matrix3Xd x(3, around * rings);
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < around; ++i) {
      const double u = 2.0 * std::numbers::pi * (i % (around - 1)) / (around - 1);
      const double v = std::numbers::pi * (static_cast<double>(j) / (rings - 1) - 0.5);
      x.col(j * around + i) = kRadius * Vector3d(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
    }
  return x;
}

// A point of a surface is the sum of its vertices times their weights; -1 stands for none.
Vector3d place(const Matrix3Xd& x, const std::array<int, 3>& vertices, const std::array<double, 3>& weights) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 3 && vertices[k] >= 0; ++k) sum += weights[k] * x.col(vertices[k]);
  return sum;
}

double give(const Body& body, const std::array<double, 3>& w) {
  return body.moves ? w[0] * w[0] + w[1] * w[1] + w[2] * w[2] : 0.0;
}

void move(Body& body, const std::array<int, 3>& vertices, const std::array<double, 3>& weights, const Vector3d& way) {
  for (std::size_t k = 0; body.moves && k < 3 && vertices[k] >= 0; ++k) body.now.col(vertices[k]) += weights[k] * way;
}

// Moves the two places of a point apart to both margins, then takes back what they slid, by Coulomb's law.
void keep_apart(const tact::ContactPoint& p, Body& a, Body& b) {
  const auto between = [&](const Matrix3Xd& xa, const Matrix3Xd& xb) -> Vector3d {
    return place(xb, p.b_vertices, p.b_weights) - place(xa, p.a_vertices, p.a_weights);
  };
  const double both = give(a, p.a_weights) + give(b, p.b_weights);
  const double missing = 2.0 * kMargin - p.normal.dot(between(a.now, b.now));
  if (both == 0.0 || missing <= 0.0) return;
  Vector3d slid = between(a.now, b.now) - between(a.before, b.before);
  slid -= slid.dot(p.normal) * p.normal;
  const double held = std::min(1.0, kFriction * missing / std::max(slid.norm(), 1e-12));
  const Vector3d way = (missing * p.normal - held * slid) / both;
  move(a, p.a_vertices, p.a_weights, -way);
  move(b, p.b_vertices, p.b_weights, way);
}

}  // namespace

int main() {
  tact::Settings settings;
  settings.outputs.points = true;
  tact::World world(settings);
  Body cloth{{}, cloth_positions(), cloth_positions(), true};
  Body ball{{}, ball_positions(41, 21), ball_positions(41, 21), false};
  cloth.id = world.add_body({.positions = cloth.now,
                             .facets = grid_facets(kSide, kSide),
                             .surface = tact::Surface::sheet,
                             .name = "cloth",
                             .margin = kMargin,
                             .self_contact = true});
  ball.id = world.add_body({.positions = ball.now,
                            .facets = grid_facets(41, 21),
                            .motion = tact::Motion::fixed,
                            .name = "ball",
                            .margin = kMargin});
  const std::vector<Spring> springs = cloth_springs(cloth.now);
  Matrix3Xd velocity = Matrix3Xd::Zero(3, cloth.now.cols());
  std::size_t crossed = 0, points = 0, self_points = 0;
  for (int substep = 0; substep < kSubsteps; ++substep) {
    cloth.before = cloth.now;
    velocity.row(2).array() -= 9.81 * kSubstep;
    velocity /= 1.0 + 2.0 * kSubstep;  // drag
    cloth.now += kSubstep * velocity;
    for (const Spring& spring : springs) {
      const Vector3d way = cloth.now.col(spring.b) - cloth.now.col(spring.a);
      const Vector3d half = 0.25 * (1.0 - spring.length / way.norm()) * way;
      cloth.now.col(spring.a) += half;
      cloth.now.col(spring.b) -= half;
    }
    world.set_positions(cloth.id, cloth.now);
    points = self_points = 0;
    for (const tact::Contact& contact : world.detect().contacts()) {
      crossed += contact.facet_pairs().size();
      Body &a = contact.a == cloth.id ? cloth : ball, &b = contact.b == cloth.id ? cloth : ball;
      for (const tact::ContactPoint& point : contact.points()) keep_apart(point, a, b);
      (contact.a == contact.b ? self_points : points) += contact.points().size();
    }
    velocity = (cloth.now - cloth.before) / kSubstep;
  }
  const double top = cloth.now.row(2).maxCoeff(), speed = std::sqrt(velocity.colwise().squaredNorm().mean());
  std::printf(
      "contact points: %zu with the ball, %zu with itself; facets that ever crossed: %zu; top at %.4f m, speed %.3f "
      "m/s\n",
      points, self_points, crossed, top, speed);
  return crossed == 0 && points > 60 && std::abs(top - kRadius - 2.0 * kMargin) < kMargin && speed < 0.5 ? 0 : 1;
}

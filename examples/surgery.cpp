// A membrane between two jaws is cut along a moving blade, tears under its weight, and its flaps come to rest on the
// organ below. Then a thread, a body of edges alone, is pulled down through the cut. Each cut is World::set_facets():
// what is still there keeps its ids. The solver is that of cloth.cpp. Status 0: nothing ever crossed, nor did the
// thread on its way, no id went over to another feature, the membrane is in two and lies on the organ, the thread is
// through.
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr int kSide = 21;                 // vertices along a side of the membrane
constexpr int kMiddle = kSide / 2;        // the column that is cut
constexpr double kSpacing = 0.05;         // metres
constexpr double kRadius = 0.6;           // of the organ, metres
constexpr double kMargin = 0.005;         // of every body, metres; surfaces are kept apart by the sum of two
constexpr double kTears = 1.02;           // an edge at the tip of the cut breaks where it is so many times as long
constexpr double kSubstep = 1.0 / 720.0;  // seconds: in one, nothing may move farther than two margins
constexpr int kSubsteps = 2880, kFirstCut = 180, kSubstepsACut = 24, kCutVertices = 17;
constexpr int kFirstPull = 1440, kThread = 13;            // vertices of the thread
constexpr double kThreadSpacing = 0.025, kPull = 0.0004;  // metres, the second in a substep
constexpr double kThreadY = -0.45;                        // where the flaps hang beside the organ

struct Spring {
  int a, b;
  double length;  // at rest, metres
};

// Vertices of which some are held, and springs between them.
struct Soft {
  Matrix3Xd now, before, velocity;
  std::vector<int> origin;  // of each vertex the place that it was made at: one number for all doubles
  std::vector<Spring> springs;
  std::vector<char> held;

  int count() const { return static_cast<int>(origin.size()); }
  bool is_held(int v) const { return held[v] != 0; }

  void add(const Vector3d& at, int place, bool is_held_there) {
    for (Matrix3Xd* columns : {&now, &before, &velocity}) columns->conservativeResize(3, count() + 1);
    now.col(count()) = before.col(count()) = at;
    velocity.col(count()).setZero();
    origin.push_back(place);
    held.push_back(is_held_there ? 1 : 0);
  }

  void fall() {
    before = now;
    for (int v = 0; v < count(); ++v) {
      if (!is_held(v)) velocity(2, v) -= 9.81 * kSubstep;
    }
    for (int v = 0; v < count(); ++v) {
      if (!is_held(v)) now.col(v) += kSubstep / (1.0 + 2.0 * kSubstep) * velocity.col(v);  // with drag
    }
  }

  void pull_springs() {
    for (const auto& [a, b, length] : springs) {
      const double give = (is_held(a) ? 0.0 : 1.0) + (is_held(b) ? 0.0 : 1.0);
      const Vector3d way = now.col(b) - now.col(a);
      if (give == 0.0 || way.isZero()) continue;
      const Vector3d share = 0.5 / give * (1.0 - length / way.norm()) * way;
      if (!is_held(a)) now.col(a) += share;
      if (!is_held(b)) now.col(b) -= share;
    }
  }
};

// In rows over the organ.
struct Membrane : Soft {
  Eigen::Matrix3Xi facets{3, 2 * (kSide - 1) * (kSide - 1)};
  int cut = 0;  // vertices of the middle column that have doubles, from the first on

  Membrane() {
    for (int v = 0; v < kSide * kSide; ++v) add(rest(v), v, v % kSide % (kSide - 1) == 0);
    for (int f = 0; f < facets.cols(); f += 2) {
      const int a = f / 2 + f / 2 / (kSide - 1), c = a + kSide;
      facets.col(f) << a, a + 1, c + 1;
      facets.col(f + 1) << a, c + 1, c;
    }
    find_springs();
  }

  static Vector3d rest(int at) {
    return {kSpacing * (at % kSide - kMiddle), kSpacing * (at / kSide - kMiddle), kRadius + 0.05};
  }

  // Along the edges of facets, and between the corners across from each other, against bending.
  void find_springs() {
    std::map<std::pair<int, int>, std::vector<int>> opposite;  // of each edge
    for (const auto& facet : facets.colwise()) {
      for (int k = 0; k < 3; ++k) opposite[std::minmax({facet[k], facet[(k + 1) % 3]})].push_back(facet[(k + 2) % 3]);
    }
    springs.clear();
    const auto join = [&](int a, int b) { springs.push_back({a, b, (rest(origin[b]) - rest(origin[a])).norm()}); };
    for (const auto& [edge, corners] : opposite) {
      join(edge.first, edge.second);
      if (corners.size() == 2) join(corners[0], corners[1]);
    }
  }

  // The next vertex of the middle column has a double, which the facets right of it take. Returns the map of vertices.
  std::vector<int> cut_once() {
    std::vector<int> map(origin.size());
    for (int v = 0; v < count(); ++v) map[v] = v;
    const int at = cut++ * kSide + kMiddle, twin = count();
    map.push_back(at);
    const Vector3d place = now.col(at), last = before.col(at), speed = velocity.col(at);
    add(place, at, is_held(at));
    before.col(twin) = last, velocity.col(twin) = speed;
    for (auto facet : facets.colwise()) {
      const bool is_right = std::any_of(facet.begin(), facet.end(), [&](int v) { return origin[v] % kSide > kMiddle; });
      for (int& v : facet) v = is_right && v == at ? twin : v;
    }
    find_springs();
    return map;
  }

  // Whether an edge at the tip of the cut is stretched too far.
  bool tears() const {
    const int tip = cut * kSide + kMiddle;
    return cut < kSide && std::ranges::any_of(springs, [&](const Spring& s) {
             return (s.a == tip || s.b == tip) && (now.col(s.b) - now.col(s.a)).norm() > kTears * s.length;
           });
  }
};

// Straight, above the membrane, and held at both ends.
struct Thread : Soft {
  Eigen::Matrix2Xi edges{2, kThread - 1};

  Thread() {
    for (int v = 0; v < kThread; ++v) {
      add({0.0, kThreadY, kRadius + 0.1 + kThreadSpacing * v}, v, v == 0 || v + 1 == kThread);
      if (v == 0) continue;
      edges.col(v - 1) << v - 1, v;
      springs.push_back({v - 1, v, kThreadSpacing});
    }
  }
  void pull() { now(2, 0) -= kPull, now(2, kThread - 1) -= kPull; }
};

// The two sides of a contact point move apart to both margins; what they slid is taken back, by Coulomb's law.
struct Side {
  Soft* soft;  // null: the organ, which stands
  const Matrix3Xd& now;
  const std::array<int, 3>& vertices;
  const std::array<double, 3>& weights;
  Vector3d at(const Matrix3Xd& x) const {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < 3 && vertices[k] >= 0; ++k) sum += weights[k] * x.col(vertices[k]);
    return sum;
  }
  Vector3d slid() const { return soft == nullptr ? Vector3d(0, 0, 0) : Vector3d(at(now) - at(soft->before)); }
  bool moves(int k) const { return soft != nullptr && vertices[k] >= 0 && !soft->is_held(vertices[k]); }
  double give() const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += moves(k) ? weights[k] * weights[k] : 0.0;
    return sum;
  }
  void move(const Vector3d& way) {
    for (int k = 0; k < 3; ++k) {
      if (moves(k)) soft->now.col(vertices[k]) += weights[k] * way;
    }
  }
};

void keep_apart(const tact::ContactPoint& p, Side a, Side b) {
  constexpr double kFriction = 0.4;
  const double both = a.give() + b.give(), missing = 2.0 * kMargin - p.normal.dot(b.at(b.now) - a.at(a.now));
  if (both == 0.0 || missing <= 0.0) return;
  Vector3d slid = b.slid() - a.slid();
  slid -= slid.dot(p.normal) * p.normal;
  const double held = std::min(1.0, kFriction * missing / std::max(slid.norm(), 1e-12));
  const Vector3d way = (missing * p.normal - held * slid) / both;
  a.move(-way);
  b.move(way);
}

// Whether features were one before the cut: their walls touch, and nothing pushes them apart.
bool share_origin(const Membrane& m, const auto& some, const auto& others) {
  for (const int v : some) {
    for (const int w : others) {
      if (v >= 0 && w >= 0 && m.origin[v] == m.origin[w]) return true;
    }
  }
  return false;
}

// Bodies, and the body itself, that a body comes to meet in this substep.
std::size_t count_impacts(tact::World& world, tact::BodyId body) {
  const auto pairs = world.detect_motion({.wanted = tact::Impacts::first_of_pair, .distance = 0.0}).pairs();
  return static_cast<std::size_t>(
      std::ranges::count_if(pairs, [&](const tact::ImpactPair& pair) { return pair.a == body || pair.b == body; }));
}

// Rolled up: its sides and ends meet, vertices may be repeated.
void make_ball(Matrix3Xd& ball, Eigen::Matrix3Xi& facets) {
  ball.resize(3, 41 * 21);
  facets.resize(3, 2 * 40 * 20);
  for (int v = 0; v < ball.cols(); ++v) {
    const double turn = std::numbers::pi * (v % 41 % 40) / 20.0, up = std::numbers::pi * (v / 41 / 20.0 - 0.5);
    ball.col(v) = kRadius * Vector3d(std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
  }
  for (int f = 0; f < facets.cols(); f += 2) {
    const int a = f / 2 + f / 2 / 40, c = a + 41;
    facets.col(f) << a, a + 1, c + 1;
    facets.col(f + 1) << a, c + 1, c;
  }
}

int main() {
  Membrane membrane;
  Thread thread;
  Matrix3Xd ball;
  Eigen::Matrix3Xi ball_facets;
  make_ball(ball, ball_facets);
  tact::World world({.outputs = {.points = true}});
  const tact::BodyId id = world.add_body({.positions = membrane.now,
                                          .facets = membrane.facets,
                                          .surface = tact::Surface::sheet,
                                          .name = "membrane",
                                          .margin = kMargin,
                                          .self_contact = true});
  const tact::BodyId organ = world.add_body(
      {.positions = ball, .facets = ball_facets, .motion = tact::Motion::fixed, .name = "organ", .margin = kMargin});
  const tact::BodyId rope =
      world.add_body({.positions = thread.now, .edges = thread.edges, .name = "thread", .margin = kMargin});
  const auto side = [&](tact::BodyId body, const std::array<int, 3>& vertices, const std::array<double, 3>& weights) {
    Soft* const soft = body == id ? &membrane : body == rope ? static_cast<Soft*>(&thread) : nullptr;
    return Side{soft, soft == nullptr ? ball : soft->now, vertices, weights};
  };
  std::size_t crossed = 0, jumps = 0, kept = 0, pierced = 0;
  std::map<std::uint64_t, int> last;  // of each point with the organ: the place where its vertex was made
  for (int substep = 0; substep < kSubsteps; ++substep) {
    membrane.fall(), thread.fall();
    if (substep >= kFirstPull && thread.now(2, 0) > kRadius - 0.1) thread.pull();
    membrane.pull_springs(), thread.pull_springs();
    const bool blade = substep >= kFirstCut && substep % kSubstepsACut == 0 && membrane.cut < kCutVertices;
    if (blade || (membrane.cut >= kCutVertices && membrane.tears())) {
      const std::vector<int> map = membrane.cut_once();
      world.set_facets(id, membrane.now, membrane.facets, map);
    } else {
      world.set_positions(id, membrane.now);
    }
    world.set_positions(rope, thread.now);
    if (substep >= kFirstPull) pierced += count_impacts(world, rope);
    std::map<std::uint64_t, int> points;
    for (const tact::Contact& contact : world.detect().contacts()) {
      const bool of_itself = contact.a == contact.b;
      for (const tact::FacetPair& pair : contact.facet_pairs())
        crossed +=
            of_itself && share_origin(membrane, membrane.facets.col(pair.a), membrane.facets.col(pair.b)) ? 0 : 1;
      for (const tact::ContactPoint& p : contact.points()) {
        if (of_itself && share_origin(membrane, p.a_vertices, p.b_vertices)) continue;
        if (!of_itself && p.kind == tact::FeaturePair::vertex_facet) points[p.id] = membrane.origin[p.a_vertices[0]];
        keep_apart(p, side(contact.a, p.a_vertices, p.a_weights), side(contact.b, p.b_vertices, p.b_weights));
      }
    }
    for (const auto& [point, origin] : points) {
      const auto was = last.find(point);
      if (was == last.end()) continue;
      ++(was->second == origin ? kept : jumps);
    }
    last = std::move(points);
    membrane.velocity = (membrane.now - membrane.before) / kSubstep;
    thread.velocity = (thread.now - thread.before) / kSubstep;
  }
  const tact::Contact* const rests = world.detect().find_contact(id, organ);
  const std::size_t points = rests == nullptr ? 0 : rests->points().size();
  const double speed = std::sqrt(membrane.velocity.colwise().squaredNorm().mean());
  std::printf(
      "%d of %d vertices cut, %zu points with the organ, %zu ids kept, %zu jumped; facets that ever crossed: "
      "%zu, the thread: %zu; its end %.3f m below the jaws; speed %.3f m/s\n",
      membrane.cut, kSide, points, kept, jumps, crossed, pierced, Membrane::rest(0).z() - thread.now(2, 0), speed);
  const bool is_through = thread.now(2, 0) < kRadius - 0.05 && pierced == 0;
  return crossed == 0 && jumps == 0 && kept > 0 && membrane.cut == kSide && points > 10 && speed < 0.5 && is_through
             ? 0
             : 1;
}

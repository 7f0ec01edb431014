// Bodies of edges and of points: what they are said to be, against the same written as facets without area, and against
// brute force.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// Facets, edges and points over some vertices.
struct MixedBody {
  Eigen::Matrix3Xd positions;
  Eigen::Matrix3Xi facets{3, 0};
  Eigen::Matrix2Xi edges{2, 0};
  std::vector<int> points;
  Surface surface = Surface::sheet;
  double margin = 0.0;
  bool self_contact = false;

  BodyDefinition definition() const {
    return {.positions = positions,
            .facets = facets,
            .edges = edges,
            .points = points,
            .surface = surface,
            .margin = margin,
            .self_contact = self_contact};
  }
  // Edges and points written as facets without area.
  Eigen::Matrix3Xi as_facets() const {
    Eigen::Matrix3Xi all(3, facets.cols() + edges.cols() + static_cast<Eigen::Index>(points.size()));
    all.leftCols(facets.cols()) = facets;
    Eigen::Index f = facets.cols();
    for (Eigen::Index e = 0; e < edges.cols(); ++e) all.col(f++) << edges(0, e), edges(1, e), edges(1, e);
    for (const int v : points) all.col(f++) << v, v, v;
    return all;
  }
  bool is_on_facet(int vertex) const { return (facets.array() == vertex).any(); }
};

Eigen::Matrix3Xd some_positions(Random& random, int count, double size) {
  Eigen::Matrix3Xd positions(3, count);
  for (int v = 0; v < count; ++v) {
    const Vec3 p = random.in_cube(size);
    positions.col(v) << p.x, p.y, p.z;
  }
  return positions;
}

MixedBody random_rope(Random& random, double size) {
  MixedBody rope;
  const int count = 2 + random.below(12);
  rope.positions = some_positions(random, count, size);
  rope.edges.resize(2, count - 1);
  for (int k = 0; k + 1 < count; ++k) rope.edges.col(k) << k, k + 1;
  return rope;
}

MixedBody random_grains(Random& random, double size) {
  MixedBody grains;
  const int count = 1 + random.below(30);
  grains.positions = some_positions(random, count, size);
  for (int v = 0; v < count; ++v) grains.points.push_back(v);
  return grains;
}

MixedBody random_mixture(Random& random, double size) {
  MixedBody all;
  const Mesh shell = soup(1 + random.below(20), size, random.bits());
  const int extra = 2 + random.below(12), shell_vertices = shell.vertex_count();
  all.positions.resize(3, shell_vertices + extra);
  all.positions << shell.positions, some_positions(random, extra, size);
  all.facets = shell.facets;
  all.edges.resize(2, 1 + random.below(6));
  for (int& v : all.edges.reshaped()) v = random.below(static_cast<int>(all.positions.cols()));
  for (int i = random.below(5); i > 0; --i) all.points.push_back(shell_vertices + random.below(extra));
  return all;
}

MixedBody random_body(Random& random, double size) {
  switch (random.below(3)) {
    case 0: return random_rope(random, size);
    case 1: return random_grains(random, size);
    default: return random_mixture(random, size);
  }
}

using Features = std::tuple<FeaturePair, std::array<int, 3>, std::array<int, 3>>;

// The name that the features of a point have, from the one that they have among facets.
Features named(const ContactPoint& point, const MixedBody& a, const MixedBody& b) {
  const auto count = [](const std::array<int, 3>& vertices) { return 3 - std::ranges::count(vertices, -1); };
  const auto is_bare = [&](const MixedBody& body, const std::array<int, 3>& vertices) {
    if (count(vertices) == 3) return false;
    for (Eigen::Index f = 0; f < body.facets.cols(); ++f) {
      const auto has = [&](int v) { return v < 0 || (body.facets.col(f).array() == v).any(); };
      if (std::ranges::all_of(vertices, has)) return false;
    }
    return true;
  };
  FeaturePair kind = point.kind;
  const bool of_a = kind == FeaturePair::vertex_facet;
  if (kind != FeaturePair::edge_edge && (is_bare(a, point.a_vertices) || is_bare(b, point.b_vertices))) {
    const auto other = count(of_a ? point.b_vertices : point.a_vertices);
    if (other == 1) kind = FeaturePair::vertex_vertex;
    if (other == 2) kind = of_a ? FeaturePair::vertex_edge : FeaturePair::edge_vertex;
  }
  std::array<int, 3> first = point.a_vertices, second = point.b_vertices;
  if (&a == &b && kind == FeaturePair::vertex_vertex && second < first) std::swap(first, second);
  return {kind, first, second};
}

struct TwoWorlds {
  World by_name{{.threads = 1, .outputs = {.points = true}}}, by_facets{{.threads = 1, .outputs = {.points = true}}};
  std::vector<BodyId> ids;
  void add(const MixedBody& body) {
    ids.push_back(by_name.add_body(body.definition()));
    BodyDefinition definition = body.definition();
    const Eigen::Matrix3Xi all = body.as_facets();
    const Eigen::Matrix2Xi no_edges(2, 0);
    definition.facets = all;
    definition.edges = no_edges;
    definition.points = {};
    by_facets.add_body(definition);
  }
};

void expect_same_points(const MixedBody& a, const MixedBody& b, const Contact* by_name, const Contact* by_facets) {
  std::map<Features, double> expected, found;
  if (by_facets != nullptr) {
    for (const ContactPoint& point : by_facets->points()) expected[named(point, a, b)] = point.gap;
  }
  if (by_name != nullptr) {
    for (const ContactPoint& point : by_name->points()) {
      const bool is_new = found.emplace(Features{point.kind, point.a_vertices, point.b_vertices}, point.gap).second;
      EXPECT_TRUE(is_new);
    }
  }
  EXPECT_EQ(found, expected);
}

TEST(EdgesAndPoints, AreFacetsWithoutAreaByOtherNames) {
  std::map<FeaturePair, int> kinds;
  int facet_pairs = 0, impacts = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    SCOPED_TRACE("seed " + std::to_string(seed));
    MixedBody a = random_body(random, 1.0), b = random_body(random, 1.0);
    a.margin = random.uniform(0.0, 0.2), b.margin = random.uniform(0.01, 0.2);
    a.self_contact = true;
    TwoWorlds worlds;
    worlds.add(a), worlds.add(b);
    const Report &named_report = worlds.by_name.detect(), &facets_report = worlds.by_facets.detect();
    const BodyId first = worlds.ids[0], second = worlds.ids[1];
    const Contact* const contact = named_report.find_contact(first, second);
    const Contact* other = nullptr;
    const Contact* other_self = nullptr;
    for (const Contact& one : facets_report.contacts()) (one.a == one.b ? other_self : other) = &one;
    ASSERT_EQ(contact != nullptr, other != nullptr);
    expect_same_points(a, b, contact, other);
    expect_same_points(a, a, named_report.find_contact(first, first), other_self);
    if (contact != nullptr) {
      EXPECT_EQ(contact->direction, other->direction);
      EXPECT_EQ(contact->depth, other->depth);
      EXPECT_EQ(contact->touching(), other->touching());
      std::vector<FacetPair> expected;
      std::ranges::copy_if(other->facet_pairs(), std::back_inserter(expected),
                           [&](const FacetPair& pair) { return pair.a < a.facets.cols() && pair.b < b.facets.cols(); });
      EXPECT_TRUE(std::ranges::equal(contact->facet_pairs(), expected));
      facet_pairs += static_cast<int>(expected.size());
      for (const ContactPoint& point : contact->points()) ++kinds[point.kind];
    }
    // Motion: the same times, under the names of edges and points.
    const Eigen::Matrix3Xd moved = some_positions(random, static_cast<int>(a.positions.cols()), 1.0);
    std::multiset<double> times, other_times;
    worlds.by_name.set_positions(first, moved);
    worlds.by_facets.set_positions(worlds.by_facets.bodies()[0], moved);
    std::set<std::pair<BodyId, Features>> seen;
    for (const Impact& impact : worlds.by_name.detect_motion().impacts()) {
      EXPECT_TRUE(seen.emplace(impact.b, Features{impact.kind, impact.a_vertices, impact.b_vertices}).second);
      const auto ends = [](const std::array<int, 3>& vertices) { return std::ranges::count(vertices, -1); };
      if (impact.kind == FeaturePair::vertex_edge) {
        EXPECT_EQ(ends(impact.b_vertices), 1);
      }
      if (impact.kind == FeaturePair::vertex_vertex) {
        EXPECT_EQ(ends(impact.b_vertices), 2);
      }
      if (impact.kind == FeaturePair::vertex_facet) {
        EXPECT_EQ(ends(impact.b_vertices), 0);
      }
      times.insert(impact.time);
    }
    for (const Impact& impact : worlds.by_facets.detect_motion().impacts()) other_times.insert(impact.time);
    EXPECT_LE(times.size(), other_times.size());
    if (!other_times.empty()) {
      ASSERT_FALSE(times.empty());
      EXPECT_EQ(*times.begin(), *other_times.begin());
    }
    impacts += static_cast<int>(times.size());
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(kinds.size(), 6u);
  EXPECT_GT(facet_pairs, 0);
  EXPECT_GT(impacts, 500);
}

// Local minima of the distance by plain loops: of a vertex along each edge, and of two edges.
std::map<Features, double> rope_points_by_brute_force(const MixedBody& a, const MixedBody& b, double reach) {
  std::map<Features, double> points;
  const auto at = [](const MixedBody& m, int v) { return Eigen::Vector3d(m.positions.col(v)); };
  const auto from_vertices = [&](const MixedBody& own, const MixedBody& other, bool of_a) {
    const auto add = [&](int v, std::array<int, 3> feature, double distance) {
      if (!(distance < reach)) return;
      const FeaturePair kind = feature[1] < 0 ? FeaturePair::vertex_vertex
                               : of_a         ? FeaturePair::vertex_edge
                                              : FeaturePair::edge_vertex;
      const std::array<int, 3> vertex{v, -1, -1};
      points[Features{kind, of_a ? vertex : feature, of_a ? feature : vertex}] = distance;
    };
    std::set<int> used_other(other.points.begin(), other.points.end()), used(own.points.begin(), own.points.end());
    used_other.insert(other.edges.data(), other.edges.data() + other.edges.size());
    used.insert(own.edges.data(), own.edges.data() + own.edges.size());
    for (const int v : used) {
      const Eigen::Vector3d p = at(own, v);
      for (Eigen::Index e = 0; e < other.edges.cols(); ++e) {
        const Eigen::Vector3d q = at(other, other.edges(0, e)), u = at(other, other.edges(1, e)) - q;
        const double t = (p - q).dot(u) / u.squaredNorm();
        const auto [first, last] = std::minmax(other.edges(0, e), other.edges(1, e));
        if (t > 0.0 && t < 1.0) add(v, {first, last, -1}, (q + t * u - p).norm());
      }
      for (const int w : used_other) {
        bool is_least = true;
        for (Eigen::Index e = 0; e < other.edges.cols(); ++e) {
          for (int k = 0; k < 2; ++k) {
            if (other.edges(k, e) == w)
              is_least &= (at(other, other.edges(1 - k, e)) - at(other, w)).dot(p - at(other, w)) <= 0.0;
          }
        }
        if (is_least) add(v, {w, -1, -1}, (at(other, w) - p).norm());
      }
    }
  };
  from_vertices(a, b, true);
  from_vertices(b, a, false);
  for (Eigen::Index e = 0; e < a.edges.cols(); ++e) {
    for (Eigen::Index f = 0; f < b.edges.cols(); ++f) {
      const Eigen::Vector3d p = at(a, a.edges(0, e)), u = at(a, a.edges(1, e)) - p, q = at(b, b.edges(0, f)),
                            w = at(b, b.edges(1, f)) - q, r = q - p;
      const double uu = u.dot(u), ww = w.dot(w), uw = u.dot(w), square = uu * ww - uw * uw;
      const double s = (u.dot(r) * ww - w.dot(r) * uw) / square, t = (u.dot(r) * uw - w.dot(r) * uu) / square;
      if (!(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)) continue;
      const double distance = (q + t * w - p - s * u).norm();
      if (distance < reach)
        points[Features{
            FeaturePair::edge_edge, {a.edges(0, e), a.edges(1, e), -1}, {b.edges(0, f), b.edges(1, f), -1}}] = distance;
    }
  }
  return points;
}

TEST(EdgesAndPoints, HaveThePointsOfBruteForce) {
  std::size_t points = 0;
  for (int seed = 0; seed < 200; ++seed) {
    Random random(static_cast<std::uint64_t>(5000 + seed));
    const double scale = std::ldexp(1.0, random.below(5) == 0 ? random.below(400) - 200 : 0);
    MixedBody a = random.chance(0.5) ? random_rope(random, 1.0) : random_grains(random, 1.0);
    MixedBody b = random.chance(0.5) ? random_rope(random, 1.0) : random_grains(random, 1.0);
    for (MixedBody* one : {&a, &b}) one->margin = scale * random.uniform(0.0, 0.3), one->positions *= scale;
    World world({.threads = 1, .outputs = {.points = true}});
    const BodyId first = world.add_body(a.definition()), second = world.add_body(b.definition());
    const Contact* const contact = world.detect().find_contact(first, second);
    const std::map<Features, double> expected = rope_points_by_brute_force(a, b, a.margin + b.margin);
    std::map<Features, double> found;
    if (contact != nullptr) {
      EXPECT_TRUE(contact->facet_pairs().empty());
      for (const ContactPoint& point : contact->points())
        found[Features{point.kind, point.a_vertices, point.b_vertices}] = point.gap;
    }
    ASSERT_EQ(found.size(), expected.size()) << "seed " << seed;
    for (const auto& [features, gap] : expected) {
      ASSERT_TRUE(found.contains(features)) << "seed " << seed;
      EXPECT_NEAR(found[features], gap, 1e-12 * scale) << "seed " << seed;
    }
    points += found.size();
  }
  EXPECT_GT(points, 1000u);
}

TEST(EdgesAndPoints, HaveNoInsideAndNoFacets) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh ball = icosphere(2);
  Eigen::Matrix3Xd positions(3, ball.vertex_count() + 4);
  positions << ball.positions, Eigen::Matrix3Xd::Zero(3, 4);
  positions.rightCols(4) << 2.0, 2.0, 2.5, 9.0, 0.0, 0.0, 0.5, 9.0, -1.0, 1.0, 0.0, 9.0;
  const int n = ball.vertex_count();
  Eigen::Matrix2Xi edges(2, 1);
  edges << n, n + 1;
  const std::vector<int> points{n + 2};
  const BodyId body = world.add_body({.positions = positions, .facets = ball.facets, .edges = edges, .points = points});
  EXPECT_EQ(world.facet_count(body), static_cast<std::size_t>(ball.facet_count()));
  EXPECT_EQ(world.edge_count(body), 1u);
  EXPECT_EQ(world.point_count(body), 1u);
  EXPECT_EQ(world.surface(body), Surface::closed);
  std::vector<int> ends(2), vertices(1), corners(3 * static_cast<std::size_t>(ball.facet_count()));
  world.copy_edges(body, ends);
  world.copy_points(body, vertices);
  world.copy_facets(body, corners);
  EXPECT_EQ(ends, (std::vector{n, n + 1}));
  EXPECT_EQ(vertices, points);
  EXPECT_EQ(corners[0], ball.facets(0, 0));
  std::vector<double> copied(3 * static_cast<std::size_t>(n + 4));
  world.copy_positions(body, copied);
  EXPECT_EQ(copied[3 * static_cast<std::size_t>(n + 2)], 2.5);
  EXPECT_TRUE(std::isnan(copied[3 * static_cast<std::size_t>(n + 3)]));
  EXPECT_LT(world.bounds(body).upper[1], 1.0 + 1e-9);
  EXPECT_EQ(world.bounds(body).upper[0], 2.5);
  // On the edge, on the point, in the ball.
  EXPECT_TRUE(world.bodies_containing({.point = {2.0, 0.0, 0.25}}).empty());
  EXPECT_TRUE(world.bodies_containing({.point = {2.5, 0.5, 0.0}}).empty());
  EXPECT_EQ(world.bodies_containing({.point = {0.1, 0.0, 0.0}}).size(), 1u);
  EXPECT_LT(world.cast_ray({.from = {3.0, 0.0, 0.25}, .to = {1.5, 0.0, 0.25}}).facet, 0);
  EXPECT_LT(world.cast_ray({.from = {3.0, 0.5, 0.0}, .to = {2.0, 0.5, 0.0}}).facet, 0);
  const ClosestPoint edge = world.closest_point({.point = {2.0, 0.3, 0.5}});
  EXPECT_EQ(edge.facet, ball.facet_count());
  EXPECT_EQ(edge.distance, 0.3);
  EXPECT_EQ(edge.barycentric, (std::array{0.25, 0.75, 0.0}));
  const ClosestPoint point = world.closest_point({.point = {2.75, 0.5, 0.0}});
  EXPECT_EQ(point.facet, ball.facet_count() + 1);
  EXPECT_EQ(point.barycentric, (std::array{1.0, 0.0, 0.0}));
  EXPECT_EQ(world.overlap_box({.lower = {1.9, -0.1, 0.4}, .upper = {2.1, 0.1, 0.6}}).size(), 1u);
  const SurfaceCheck check = world.check_surface(body);
  EXPECT_TRUE(check.is_clean());
  EXPECT_TRUE(check.is_solid());
  EXPECT_EQ(check.unused_vertices, std::vector{n + 3});
}

TEST(EdgesAndPoints, WithoutFacetsAreASheet) {
  World world({.threads = 1});
  Eigen::Matrix3Xd positions(3, 3);
  positions << 0, 1, 2, 0, 0, 0, 0, 0, 0;
  Eigen::Matrix2Xi edges(2, 2);
  edges << 0, 1, 1, 2;
  const BodyId rope = world.add_body({.positions = positions, .edges = edges, .surface = Surface::closed});
  EXPECT_EQ(world.surface(rope), Surface::sheet);
  EXPECT_TRUE(world.bodies_containing({.point = {0.5, 0.0, 0.0}}).empty());
  const auto code_of = [&](const BodyDefinition& definition) -> std::optional<ErrorCode> {
    try {
      world.add_body(definition);
    } catch (const Error& error) {
      return error.code();
    }
    return {};
  };
  edges(1, 1) = 3;
  EXPECT_EQ(code_of({.positions = positions, .edges = edges}), ErrorCode::facet_out_of_range);
  const std::vector<int> points{0, -1};
  EXPECT_EQ(code_of({.positions = positions, .points = points}), ErrorCode::facet_out_of_range);
  const Eigen::MatrixXi wrong = Eigen::MatrixXi::Zero(3, 1);
  EXPECT_EQ(code_of({.positions = positions, .edges = wrong}), ErrorCode::wrong_size);
  EXPECT_EQ(world.body_count(), 1u);
}

// A rope that sinks into a ball is deep there, and one that lies on it is not.
TEST(EdgesAndPoints, SinkIntoSolids) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh ball = icosphere(3);
  const BodyId solid = world.add_body({.positions = ball.positions, .facets = ball.facets, .margin = 0.01});
  Eigen::Matrix3Xd positions(3, 21);
  Eigen::Matrix2Xi edges(2, 20);
  const auto rope_at = [&](double height) {
    for (int k = 0; k < 21; ++k) positions.col(k) << 0.1 * (k - 10), 0.013, height;
    return positions;
  };
  for (int k = 0; k < 20; ++k) edges.col(k) << k, k + 1;
  const BodyId rope = world.add_body({.positions = rope_at(1.015), .edges = edges, .margin = 0.01});
  const auto lowest = [&] {
    double gap = std::numeric_limits<double>::infinity();
    for (const ContactPoint& point : world.detect().find_contact(solid, rope)->points()) gap = std::min(gap, point.gap);
    return gap;
  };
  EXPECT_GT(lowest(), 0.01);
  world.set_positions(rope, rope_at(0.97));
  EXPECT_LT(lowest(), -0.025);
  EXPECT_GT(lowest(), -0.035);
  EXPECT_TRUE(world.detect().find_contact(solid, rope)->facet_pairs().empty());
  EXPECT_TRUE(world.detect().find_contact(solid, rope)->touching());
}

TEST(EdgesAndPoints, AreSavedAndRecorded) {
  std::ostringstream recorded;
  Recorder recorder(recorded);
  World world({.threads = 1, .outputs = {.patches = true, .points = true}});
  world.set_observer(&recorder);
  Random random(3);
  MixedBody a = random_mixture(random, 1.0), b = random_rope(random, 1.0);
  a.margin = b.margin = 0.2, a.self_contact = b.self_contact = true;
  const BodyId first = world.add_body(a.definition()), second = world.add_body(b.definition());
  world.detect();
  b.positions *= 0.9;
  world.set_positions(second, b.positions);
  world.detect();
  const std::vector<std::byte> state = world.save();
  World other({.threads = 1});
  other.restore(state);
  EXPECT_EQ(other.save(), state);
  EXPECT_EQ(other.edge_count(other.bodies()[0]), world.edge_count(first));
  EXPECT_EQ(other.point_count(other.bodies()[0]), world.point_count(first));
  b.positions *= 0.8;
  for (World* one : {&world, &other}) one->set_positions(one->bodies()[1], b.positions);
  EXPECT_EQ(world.detect().hash(), other.detect().hash());
  const std::string bytes = recorded.str();
  RecordingPlayer player(bytes);
  int steps = 0;
  for (; const auto step = player.next(); ++steps) EXPECT_TRUE(step->same());
  EXPECT_EQ(steps, 3);
}

}  // namespace
}  // namespace tact::tests

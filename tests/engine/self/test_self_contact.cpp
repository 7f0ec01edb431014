// Contact of a body with itself, against oracles: facet pairs by CGAL, contact points by brute force.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/facet_pair_oracle.h"
#include "tests/support/oracles/point_oracle.h"

namespace tact::tests {
namespace {

// A world with one body that is held against itself.
class SelfWorld {
 public:
  SelfWorld(const Mesh& mesh, double margin, int threads = 2)
      : world_({.threads = threads, .outputs = {.points = margin > 0.0}}),
        id_(world_.add_body({.positions = mesh.positions,
                             .facets = mesh.facets,
                             .surface = Surface::sheet,
                             .margin = margin,
                             .self_contact = true})) {}
  void move_to(const Mesh& mesh) { world_.set_positions(id_, mesh.positions); }
  // Null where the body is not in contact with itself.
  const Contact* detect() {
    const Report& report = world_.detect();
    hash_ = report.hash();
    return report.contacts().empty() ? nullptr : &report.contacts()[0];
  }
  std::vector<FacetPair> facet_pairs() {
    const Contact* contact = detect();
    if (contact == nullptr) return {};
    return {contact->facet_pairs().begin(), contact->facet_pairs().end()};
  }
  std::uint64_t hash() const { return hash_; }

 private:
  World world_;
  BodyId id_;
  std::uint64_t hash_ = 0;
};

void expect_points_of_brute_force(SelfWorld& world, const Mesh& mesh, double margin, const std::string& what) {
  const double band = 1e-12 * extent(mesh);
  const auto expected = self_points_by_brute_force(mesh, 2 * margin, band);
  std::set<PointKey> seen;
  if (const Contact* contact = world.detect()) {
    for (const ContactPoint& point : contact->points()) {
      const PointKey key{point.kind, point.a_vertices, point.b_vertices};
      const auto known = expected.find(key);
      ASSERT_NE(known, expected.end()) << what << ", vertex " << point.a_vertices[0] << ", gap " << point.gap;
      EXPECT_TRUE(seen.insert(key).second) << what;
      EXPECT_NEAR(point.gap, known->second.gap, 10 * band) << what;
    }
  }
  for (const auto& [key, point] : expected)
    ASSERT_TRUE(!point.certain || seen.contains(key)) << what << ", gap " << point.gap;
}

// A sheet on its way into a roll: the clusters are those of the flat sheet.
Mesh half_rolled(int cells_x, int cells_y, double part) {
  const Mesh roll = rolled_sheet(cells_x, cells_y, 2.2 * part + 1e-3, 0.12 / (part + 0.1), 0.05);
  return jittered(roll, 0.002, static_cast<std::uint64_t>(1000 * part));
}

TEST(SelfContactPoints, EqualBruteForce) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    for (const auto& [name, mesh] : folded_meshes(10, seed)) {
      for (const double margin : {0.002, 0.03}) {
        SelfWorld world(mesh, margin);
        expect_points_of_brute_force(world, mesh, margin, name + ", margin " + std::to_string(margin));
      }
    }
  }
}

TEST(SelfContactPoints, OfASheetThatIsRolledUpEqualBruteForce) {
  const double margin = 0.04;
  SelfWorld world(half_rolled(30, 8, 0.0), margin);
  std::size_t points = 0;
  for (const double part : {0.2, 0.6, 0.8, 1.0}) {
    const Mesh mesh = half_rolled(30, 8, part);
    world.move_to(mesh);
    expect_points_of_brute_force(world, mesh, margin, "part " + std::to_string(part));
    const Contact* contact = world.detect();
    points += contact == nullptr ? 0 : contact->points().size();
  }
  EXPECT_GT(points, 50u);
}

TEST(SelfContactPoints, OfFlatSheetsAndConvexBodiesAreNone) {
  const auto expect_none = [](const Mesh& mesh, double edge, const std::string& what) {
    for (const double margin : {1e-6 * edge, 0.01 * edge, 0.1 * edge, 0.5 * edge, 2.0 * edge, 5.0 * edge}) {
      SelfWorld world(mesh, margin);
      EXPECT_EQ(world.detect(), nullptr) << what << ", margin " << margin / edge << " edges";
    }
  };
  for (const int cells : {1, 7, 40, 90}) {
    const Mesh flat = sheet(cells, cells, 1.0, 1.0);
    expect_none(flat, 1.0 / cells, "sheet of " + std::to_string(cells));
    expect_none(rotated(flat, Random(1).rotation()), 1.0 / cells, "turned sheet of " + std::to_string(cells));
    expect_none(jittered(flat, 1e-3 / cells, 1), 1.0 / cells, "uneven sheet of " + std::to_string(cells));
  }
  for (const int cuts : {2, 3, 4}) expect_none(icosphere(cuts), 1.1 / (1 << cuts), "sphere");
  expect_none(gridded_box({-1, -1, -1}, {1, 1, 1}, 20), 0.1, "box");
  for (const double margin : {1e-6, 0.01, 0.1}) {
    SelfWorld world(centered_box({1, 1, 1}), margin);
    EXPECT_EQ(world.detect(), nullptr) << "coarse box, margin " << margin;
  }
}

TEST(SelfContactFacets, EqualTheOracleWhole) {
  std::size_t pairs = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const auto& [name, mesh] : folded_meshes(30, seed)) {
      const auto expected = self_facet_pairs_by_oracle(mesh);
      EXPECT_TRUE(same_facet_pairs(expected, SelfWorld(mesh, 0.0).facet_pairs())) << name << ", seed " << seed;
      pairs += expected.size();
    }
  }
  EXPECT_GT(pairs, 10000u);
}

TEST(SelfContactFacets, EqualTheOracleInBrokenMeshes) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    for (const auto& [name, whole] : folded_meshes(20, seed)) {
      const Mesh mesh = broken(whole, seed);
      EXPECT_TRUE(same_facet_pairs(self_facet_pairs_by_oracle(mesh), SelfWorld(mesh, 0.0).facet_pairs()))
          << name << ", seed " << seed;
    }
  }
}

TEST(SelfContactFacets, OfASheetThatIsRolledUpEqualTheOracle) {
  SelfWorld one(half_rolled(80, 30, 0.0), 0.01, 1), two(half_rolled(80, 30, 0.0), 0.01, 2);
  for (int step = 1; step <= 10; ++step) {
    Mesh mesh = half_rolled(80, 30, 0.1 * step);
    if (step % 2 == 0) mesh = jittered(mesh, 0.03, 1);  // layers cross
    one.move_to(mesh);
    two.move_to(mesh);
    const auto expected = self_facet_pairs_by_oracle(mesh);
    EXPECT_TRUE(same_facet_pairs(expected, one.facet_pairs())) << "step " << step;
    EXPECT_TRUE(same_facet_pairs(expected, two.facet_pairs())) << "step " << step;
    EXPECT_EQ(one.hash(), two.hash());
  }
}

Mesh mesh_of(const std::vector<Vec3>& vertices, const std::vector<std::array<int, 3>>& facets) {
  MeshBuilder builder;
  for (const Vec3 p : vertices) builder.vertex(p);
  for (const auto& [i, j, k] : facets) builder.facet(i, j, k);
  return builder.mesh();
}

// Facets with a common vertex or edge: a pair where they share more than that.
TEST(SelfContactFacets, ThatShareVerticesMeetWhereTheyCrossBeyond) {
  const Vec3 o{0, 0, 0}, x{2, 0, 0}, y{0, 2, 0};
  const std::vector<FacetPair> pair{{0, 1}};
  const auto pairs = [](const Mesh& mesh) { return SelfWorld(mesh, 0.0).facet_pairs(); };
  // An edge of one runs through the other; a facet is folded flat onto its neighbour; one is listed twice.
  EXPECT_EQ(pairs(mesh_of({o, x, y, {0.5, 0.5, -1}, {0.5, 0.5, 1}}, {{0, 1, 2}, {0, 3, 4}})), pair);
  EXPECT_EQ(pairs(mesh_of({o, x, y, {0.4, 1, 0}}, {{0, 1, 2}, {1, 0, 3}})), pair);
  EXPECT_EQ(pairs(mesh_of({o, x, y}, {{0, 1, 2}, {2, 1, 0}})), pair);
  // They touch in the common vertex or edge alone: beside each other, standing on an edge, folded and a little open.
  EXPECT_TRUE(pairs(mesh_of({o, x, y, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}})).empty());
  EXPECT_TRUE(pairs(mesh_of({o, x, y, {0.4, 1, 1e-300}}, {{0, 1, 2}, {1, 0, 3}})).empty());
  // A vertex inside the edge of another facet meets that facet: so do those at it that share an end of that edge.
  const Mesh split = mesh_of({o, x, y, {1, 0, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}});
  EXPECT_EQ(pairs(split), (std::vector<FacetPair>{{0, 1}, {0, 2}}));
  // A facet without area between them has no more than its edges in common with either.
  const Mesh filled = mesh_of({o, x, y, {1, 0, 0}, {1, -1, 0}}, {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}, {0, 3, 1}});
  EXPECT_EQ(pairs(filled), (std::vector<FacetPair>{{0, 1}, {0, 2}}));
}

// Vertices of a body are pushed through facets beside them.
TEST(SelfContactFacets, OfABodyWithNoiseAreThoseOfCgal) {
  std::size_t with_common = 0;
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Mesh mesh = jittered(icosphere(2), 0.2, seed);
    const auto found = SelfWorld(mesh, 0.0).facet_pairs();
    const auto by_cgal = self_facet_pairs_by_cgal(mesh);
    ASSERT_TRUE(by_cgal);
    EXPECT_TRUE(same_facet_pairs(*by_cgal, found));
    EXPECT_TRUE(same_facet_pairs(self_facet_pairs_by_oracle(mesh), found));
    for (const FacetPair& pair : found) {
      const auto f = mesh.facets.col(pair.a), g = mesh.facets.col(pair.b);
      with_common += std::ranges::find_first_of(f, g) != f.end() ? 1 : 0;
    }
  }
  EXPECT_GT(with_common, 20u);
}

// A vertex of many facets: a cone is fine, one whose facets turn twice about it is not.
TEST(SelfContactFacets, AtAVertexOfManyFacetsEqualTheOracle) {
  const auto cone = [](int facets, double turns) {
    MeshBuilder builder;
    builder.vertex({0, 0, 1});
    for (int i = 0; i < facets; ++i) {
      const double angle = 2.0 * std::numbers::pi * turns * i / facets;
      builder.vertex({std::cos(angle), std::sin(angle), 0.001 * (i % 7)});
    }
    for (int i = 0; i < facets; ++i) builder.facet(0, 1 + i, 1 + (i + 1) % facets);
    return builder.mesh();
  };
  EXPECT_TRUE(SelfWorld(cone(400, 1.0), 0.0).facet_pairs().empty());
  const Mesh twice = cone(151, 2.0);
  const auto expected = self_facet_pairs_by_oracle(twice);
  EXPECT_GT(expected.size(), 10u);
  EXPECT_TRUE(same_facet_pairs(expected, SelfWorld(twice, 0.0).facet_pairs()));
}

std::vector<BodyId> add_folded_bodies(World& world) {
  std::vector<BodyId> ids;
  double x = 0.0;
  for (const int cells : {10, 60, 12, 14, 40, 8}) {
    const Mesh mesh = jittered(half_rolled(cells, 20, 1.0), 0.03, 1);
    ids.push_back(world.add_body({.positions = translated(mesh, {x, 0.0, 0.0}).positions,
                                  .facets = mesh.facets,
                                  .surface = Surface::sheet,
                                  .margin = 0.005,
                                  .self_contact = true}));
    x += 10.0;
  }
  return ids;
}

// Large and small ones, side by side and cut into ranges.
TEST(SelfContact, OfManyBodiesIsTheSameForAnyNumberOfThreads) {
  World alone({.threads = 1, .outputs = {.points = true}});
  const std::vector<BodyId> ids = add_folded_bodies(alone);
  const Report& expected = alone.detect();
  ASSERT_EQ(expected.contacts().size(), ids.size());
  for (const int threads : {2, 3, 8}) {
    World world({.threads = threads, .outputs = {.points = true}});
    add_folded_bodies(world);
    EXPECT_EQ(world.detect().hash(), expected.hash()) << threads << " threads";
    world.set_settings(world.settings());  // looks at all of them again
    EXPECT_EQ(world.detect().hash(), alone.detect().hash()) << threads << " threads";
    alone.set_settings(alone.settings());
    alone.detect();
  }
}

// Two facets of one body that cross.
BodyId add_crossed_facets(World& world, bool self_contact) {
  Eigen::Matrix3Xd positions(3, 6);
  Eigen::Matrix3Xi facets(3, 2);
  positions << 0, 1, 0, 0.2, 0.2, 0.2,  //
      0, 0, 1, 0.2, 0.3, 0.2,           //
      0, 0, 0, -1, 1, 1;
  facets << 0, 3, 1, 4, 2, 5;
  return world.add_body(
      {.positions = positions, .facets = facets, .surface = Surface::sheet, .self_contact = self_contact});
}

// The record of the one may lie where that of the other was.
TEST(SelfContact, GoesFromOneBodyToAnotherBetweenTwoSteps) {
  World world({.threads = 1}), fresh({.threads = 1});
  const BodyId a = add_crossed_facets(world, false), b = add_crossed_facets(world, true);
  const BodyId fresh_a = add_crossed_facets(fresh, true);
  add_crossed_facets(fresh, false);
  ASSERT_NE(world.detect().find_contact(b, b), nullptr);
  world.set_self_contact(b, false);
  world.set_self_contact(a, true);
  const Report& report = world.detect();
  ASSERT_NE(report.find_contact(a, a), nullptr);
  EXPECT_EQ(report.find_contact(b, b), nullptr);
  ASSERT_EQ(report.began().size(), 1u);
  EXPECT_EQ(report.began()[0].a, a);
  ASSERT_EQ(report.ended().size(), 1u);
  EXPECT_EQ(report.ended()[0].a, b);
  const Report& expected = fresh.detect();
  ASSERT_NE(expected.find_contact(fresh_a, fresh_a), nullptr);
  ASSERT_EQ(report.contacts().size(), expected.contacts().size());
  for (std::size_t i = 0; i < expected.contacts().size(); ++i) {
    EXPECT_EQ(report.contacts()[i].a.index, expected.contacts()[i].a.index);
    EXPECT_EQ(report.contacts()[i].b.index, expected.contacts()[i].b.index);
  }
}

// Its own layer and mask do not say whether a body is tested against itself; nor do labels that nothing has.
TEST(SelfContactFilters, OfLabelsThatNothingHasLeaveOutNothing) {
  MeshBuilder builder;
  builder.triangle({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0});
  builder.triangle({1.0, 0.1, 1.0}, {0.0, 0.1, 0.5}, {0.5, -1.0, 0.5});
  const Mesh mesh = builder.mesh();
  World world({.threads = 1, .outputs = {.points = true, .within_reach = true}});
  const BodyId body = world.add_body({.positions = mesh.positions,
                                      .facets = mesh.facets,
                                      .surface = Surface::sheet,
                                      .layer = 2,
                                      .mask = 1,
                                      .margin = 1.0,
                                      .self_contact = true});
  const auto found = [&] {
    const Report& report = world.detect();
    if (report.contacts().empty()) return std::array<std::size_t, 3>{};
    const Contact& contact = report.contacts()[0];
    return std::array{contact.facet_pairs().size(), contact.points().size(), contact.within_reach().size()};
  };
  const std::array<std::size_t, 3> before = found();
  EXPECT_TRUE(before[0] > 0 && before[1] > 0 && before[2] > 0);
  const std::vector<std::uint32_t> vertices(6, 5), facets(2, 7);
  world.set_feature_settings(body, {.vertex_labels = vertices, .facet_labels = facets});
  for (const LabelKind kind : {LabelKind::vertex, LabelKind::facet}) {
    world.set_excluded_labels({body, 1, body, 1, kind}, true);
    EXPECT_EQ(found(), before);
  }
  world.set_excluded_labels({body, 7, body, 7, LabelKind::facet}, true);
  EXPECT_EQ(found(), (std::array<std::size_t, 3>{}));
}

// A filter that was set while there were no vertices: all rest where they are set.
TEST(SelfContactFilters, OfABodyWithoutVerticesAreThoseOfItsFirst) {
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId body = world.add_body({.positions = Eigen::Matrix3Xd(3, 0),
                                      .facets = Eigen::Matrix3Xi(3, 0),
                                      .surface = Surface::sheet,
                                      .margin = 0.1,
                                      .self_contact = true});
  world.set_self_contact_filter(body, {.rest_distance = 0.5});
  Eigen::Matrix3Xd x(3, 6);
  x << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0.1, 0.1, 0.1;
  Eigen::Matrix3Xi facets(3, 2);
  facets << 0, 3, 1, 4, 2, 5;
  world.set_facets(body, x, facets, std::vector<int>(6, -1));
  EXPECT_EQ(world.self_contact_filter(body).rest_positions.cols(), 6);
  EXPECT_TRUE(world.detect().contacts().empty());
  World other;
  other.restore(world.save());
  world.set_self_contact_filter(body, {.rest_distance = 0.05});
  EXPECT_FALSE(world.detect().contacts().empty());
}

}  // namespace
}  // namespace tact::tests

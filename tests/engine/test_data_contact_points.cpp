// The engine's contact points, and facet pairs of bodies with themselves, on real meshes.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/data.h"
#include "tests/support/detection.h"
#include "tests/support/oracle.h"
#include "tests/support/point_oracle.h"

namespace tact::tests {
namespace {

// The engine's points of two bodies are those of brute force, outside a band of 1e-12 of the size.
void expect_points_of_brute_force(const Report& report, const Mesh& a, const Mesh& b, double reach,
                                  const std::string& what) {
  const double band = 1e-12 * std::max(extent(a), extent(b));
  const auto expected = points_by_brute_force(a, b, reach, band);
  std::set<PointKey> seen;
  if (!report.contacts().empty()) {
    for (const ContactPoint& point : report.contacts()[0].points()) {
      const PointKey key{point.kind, point.a_vertices, point.b_vertices};
      ASSERT_TRUE(expected.contains(key)) << what;
      EXPECT_TRUE(seen.insert(key).second) << what;
      EXPECT_NEAR(point.gap, expected.at(key).gap, 10 * band) << what;
    }
  }
  for (const auto& [key, point] : expected)
    ASSERT_TRUE(!point.certain || seen.contains(key)) << what << ", gap " << point.gap;
}

TEST(DataContactPoints, OfAClothThatFallsOnASphereEqualBruteForce) {
  TACT_SKIP_WITHOUT_DATA();
  const Mesh sphere = read_data("cloth_sphere.obj");
  const Sequence cloth = read_data_sequence("seq_cloth_on_sphere");
  World world({.threads = 2, .outputs = {.points = true}});
  const BodyId id =
      world.add_body({.positions = cloth.frames[0], .facets = cloth.facets, .surface = Surface::sheet, .margin = 0.02});
  world.add_body({.positions = sphere.positions, .facets = sphere.facets, .margin = 0.02});
  std::size_t points = 0;
  for (std::size_t frame = 0; frame < cloth.frames.size(); frame += 6) {
    world.set_positions(id, cloth.frames[frame]);
    const Report& report = world.detect();
    if (!report.contacts().empty()) points += report.contacts()[0].points().size();
    expect_points_of_brute_force(report, {cloth.frames[frame], cloth.facets}, sphere, 0.04,
                                 "frame " + std::to_string(frame));
  }
  EXPECT_GT(points, 100u);
}

std::vector<FacetPair> self_facet_pairs_by_engine(const Mesh& mesh, int threads) {
  World world({.threads = threads});
  world.add_body({.positions = mesh.positions, .facets = mesh.facets, .self_contact = true});
  const Report& report = world.detect();
  if (report.contacts().empty()) return {};
  EXPECT_EQ(report.contacts()[0].a, report.contacts()[0].b);
  return {report.contacts()[0].facet_pairs().begin(), report.contacts()[0].facet_pairs().end()};
}

TEST(DataSelfContact, FacetPairsEqualTheOracle) {
  TACT_SKIP_WITHOUT_DATA();
  for (const char* name : {"spot.ply", "fish.obj", "dress.ply", "messy/cycloidal.ply",
                           "messy/openscad-nonmanifold-crash.obj", "messy/l_tibia_SOMEINVERTEDFACES.obj",
                           "messy/triple_vierbein.obj", "small_answers/two-cubes-intersecting.ply"}) {
    const Mesh mesh = read_data(name);
    EXPECT_TRUE(same_facet_pairs(self_facet_pairs_by_oracle(mesh), self_facet_pairs_by_engine(mesh, 2))) << name;
  }
}

// Counts as SOURCES.md gives them.
TEST(DataSelfContact, PosesOfAToyHaveTheKnownNumberOfPairs) {
  TACT_SKIP_WITHOUT_DATA();
  const Sequence toy = read_data_sequence("seq_toy_poses");
  const std::vector<std::size_t> known = {117, 46, 41, 41, 0, 84, 0, 100, 4, 73, 93};
  ASSERT_EQ(toy.frames.size(), known.size());
  World world({.threads = 2});
  const BodyId id = world.add_body({.positions = toy.frames[0], .facets = toy.facets, .self_contact = true});
  for (std::size_t frame = 0; frame < known.size(); ++frame) {
    world.set_positions(id, toy.frames[frame]);
    const Report& report = world.detect();
    const std::size_t found = report.contacts().empty() ? 0 : report.contacts()[0].facet_pairs().size();
    EXPECT_EQ(found, known[frame]) << "pose " << frame + 1;
  }
}

}  // namespace
}  // namespace tact::tests

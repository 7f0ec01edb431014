// The engine's contact points, and facet pairs of bodies with themselves, on real meshes.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/checks/detection.h"
#include "tests/support/data/data_sets.h"
#include "tests/support/oracles/point_oracle.h"

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

}  // namespace
}  // namespace tact::tests

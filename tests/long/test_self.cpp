// Facet pairs and contact points of bodies with themselves: rolled, folded, cut and broken sheets through the engine,
// against CGAL and brute force. Not part of the ordinary tests: how many kinds of each is read from the environment.
//   TACT_LONG_SELF_SEEDS  1 if not set; a seed takes some seconds
//   TACT_LONG_SEED        which, 1 if not set
#include <gtest/gtest.h>
#include <tact/world.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tests/support/environment/environment.h"
#include "tests/support/generators/folds.h"
#include "tests/support/oracles/facet_pair_oracle.h"
#include "tests/support/oracles/point_oracle.h"

namespace tact::tests {
namespace {

World world_of(const Mesh& mesh, double margin) {
  World world({.threads = 1, .outputs = {.points = margin > 0.0}});
  world.add_body({.positions = mesh.positions,
                  .facets = mesh.facets,
                  .surface = Surface::sheet,
                  .margin = margin,
                  .self_contact = true});
  return world;
}

void expect_facet_pairs_of_the_oracle(const Mesh& mesh, const std::string& what) {
  World world = world_of(mesh, 0.0);
  const Report& report = world.detect();
  std::vector<FacetPair> found;
  if (!report.contacts().empty())
    found.assign(report.contacts()[0].facet_pairs().begin(), report.contacts()[0].facet_pairs().end());
  EXPECT_EQ(found, self_facet_pairs_by_oracle(mesh)) << what;
}

TEST(SelfLong, FacetPairsEqualTheOracle) {
  for_seeds("TACT_LONG_SELF_SEEDS", 1, [](std::uint64_t seed) {
    for (const int cells : {14, 24, 40}) {
      for (const auto& [name, mesh] : folded_meshes(cells, seed)) {
        const std::string what = name + ", " + std::to_string(cells) + " cells, seed " + std::to_string(seed);
        expect_facet_pairs_of_the_oracle(mesh, what);
        expect_facet_pairs_of_the_oracle(broken(mesh, seed), "broken " + what);
      }
    }
  });
}

TEST(SelfLong, PointsEqualBruteForce) {
  for_seeds("TACT_LONG_SELF_SEEDS", 1, [](std::uint64_t seed) {
    for (const auto& [name, mesh] : folded_meshes(14, seed)) {
      for (const double margin : {0.001, 0.01, 0.08}) {
        const std::string what = name + ", margin " + std::to_string(margin) + ", seed " + std::to_string(seed);
        const auto expected = self_points_by_brute_force(mesh, 2 * margin, 1e-12 * extent(mesh));
        World world = world_of(mesh, margin);
        const Report& report = world.detect();
        std::set<PointKey> seen;
        if (!report.contacts().empty()) {
          for (const ContactPoint& point : report.contacts()[0].points()) {
            const PointKey key{point.kind, point.a_vertices, point.b_vertices};
            EXPECT_TRUE(expected.contains(key)) << what;
            EXPECT_TRUE(seen.insert(key).second) << what;
          }
        }
        for (const auto& [key, point] : expected)
          EXPECT_TRUE(!point.certain || seen.contains(key)) << what << ", gap " << point.gap;
      }
    }
  });
}

}  // namespace
}  // namespace tact::tests

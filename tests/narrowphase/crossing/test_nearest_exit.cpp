#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "narrowphase/crossing/nearest_exit.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/oracles/query_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;
using tests::Random;

// Lengths and cosines that are nearer than this to a threshold may be told either way.
constexpr double kBand = 1e-9;

// The facets that see `v` from behind and face `facing`; with those within the band or without.
Mesh facing_facets(const Mesh& mesh, Vec3 v, Vec3 facing, double cosine, double band) {
  std::vector<int> kept;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Triangle t = tests::facet_at(mesh, f);
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]), unit = (1.0 / norm(normal)) * normal;
    if (dot(v - t[0], unit) < band && dot(unit, facing) > cosine - band) kept.push_back(f);
  }
  Mesh some{mesh.positions, Eigen::Matrix3Xi(3, kept.size())};
  for (std::size_t k = 0; k < kept.size(); ++k) some.facets.col(static_cast<int>(k)) = mesh.facets.col(kept[k]);
  return some;
}

// Many vertices of one surface, whose lengths are `scale` times as large in its own unit; so many that what is learned
// of its clusters is used: the nearest place of brute force.
void expect_exits_of_brute_force(const Mesh& mesh, double scale, std::uint64_t seed) {
  Mesh in_other_unit = mesh;
  in_other_unit.positions *= 1.0 / scale;
  const ClusteredMesh clustered = tests::clustered(in_other_unit);
  const Features features(clustered);
  ExitFinder finder;
  finder.begin({clustered, features, scale});
  Random random(seed);
  int exits = 0, none = 0, far = 0;
  for (int k = 0; k < 120; ++k) {
    const Vec3 v = 0.9 * random.in_ball(), facing = k % 3 == 0 ? Vec3{0.6, 0.0, 0.8} : random.direction();
    const double cosine = k % 2 == 0 ? 0.05 : 0.5, within = random.uniform(0.1, 2.0);
    const auto exit = finder.nearest_exit(v, facing, cosine, within, -1);
    const Mesh certain = facing_facets(mesh, v, facing, cosine, -kBand);
    const Mesh possible = facing_facets(mesh, v, facing, cosine, kBand);
    const auto distance_to = [&](const Mesh& some) {
      return some.facet_count() == 0 ? 1e300 : static_cast<double>(tests::distance_by_brute_force(some, v));
    };
    const double most = distance_to(certain), least = distance_to(possible);
    if (!exit) {
      EXPECT_GT(most, within - 1e-12) << "point " << k;
      ++none;
      continue;
    }
    ++exits;
    far += exit->distance > 0.5;
    EXPECT_LE(exit->distance, within);
    EXPECT_LE(exit->distance, most + 1e-12) << "point " << k;
    EXPECT_GE(exit->distance, least - 1e-12) << "point " << k;
  }
  EXPECT_GT(exits, 50);
  EXPECT_GT(none, 5);
  EXPECT_GT(far, 10);
}

TEST(NearestExit, IsTheNearestFacingPlaceOfBruteForce) {
  expect_exits_of_brute_force(tests::blob(4, 1.0, 0.3, 7), 1.0, 11);
  expect_exits_of_brute_force(tests::icosphere(4), 1.0, 12);
}

TEST(NearestExit, IsTheSameInOtherUnits) {
  expect_exits_of_brute_force(tests::blob(3, 1.0, 0.3, 8), 0x1p300, 13);
  expect_exits_of_brute_force(tests::blob(3, 1.0, 0.3, 9), 0x1p-300, 14);
  expect_exits_of_brute_force(tests::blob(3, 1.0, 0.3, 9), 0x1p-450, 15);
}

// Beyond the tip of four facets, two of which lie in the plane across the other two, on either side of their edge: one
// says that the vertex is as far above the sheet as the other says it is below.
TEST(NearestExit, ThroughASheetIsNoneWhereFacetsContradictEachOther) {
  Mesh sheet;
  sheet.positions.resize(3, 6);
  sheet.positions.transpose() << 0, 0, 0, 1, 0, 0, 1, 0, -1, 0, 0, -1, 1, 1, 0, 1, -1, 0;
  sheet.facets.resize(3, 4);
  sheet.facets.transpose() << 1, 2, 0, 2, 3, 0, 4, 1, 0, 0, 1, 5;
  const Vec3 beyond{-0.3, 0.01, 0.2};
  std::vector<int> order{0, 1, 2, 3};
  do {
    const ClusteredMesh mesh({sheet.positions.data(), 18}, {sheet.facets.data(), 12}, order);
    const Features features(mesh);
    ExitFinder finder;
    finder.begin({mesh, features, 1.0});
    EXPECT_FALSE(finder.nearest_exit_through(beyond, 1.0, -1)) << ::testing::PrintToString(order);
    const auto through = finder.nearest_exit_through({0.5, 0.25, 0.25}, 1.0, -1);  // above one facet alone
    ASSERT_TRUE(through);
    EXPECT_EQ(mesh.source_facet(through->exit.facet), 2);
  } while (std::ranges::next_permutation(order).found);
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include "narrowphase/mesh/refit.h"
#include "narrowphase/pairs/cluster_pairs.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

// Held against each other one by one.
std::vector<ClusterPair> pairs_by_loop(const ClusterBoxes& a, const ClusterBoxes& b, double reach) {
  std::vector<ClusterPair> pairs;
  for (int i = 0; i < a.mesh->cluster_count(); ++i) {
    const Box box = base::grown(a[i], reach);
    for (int k = a.mesh == b.mesh ? i : 0; k < b.mesh->cluster_count(); ++k) {
      if (overlaps(box, b[k])) pairs.push_back({i, k});
    }
  }
  return pairs;
}

// Still, grown and swept; by the loops and by the trees; one finder for all.
void expect_pairs_of_loop(const ClusterBoxes& a, const ClusterBoxes& b, ClusterPairFinder& finder,
                          EmbreeDevice& device) {
  // Of a distance that no two boxes here have: at the reach itself rounding decides.
  for (const double reach : {0.0, 0.047}) {
    const std::vector<ClusterPair> expected = pairs_by_loop(a, b, reach);
    for (tests::NamedTuning way : tests::kTunings) {
      way.tuning.worth_planes = base::Tuning::kNever;  // of boxes alone
      const auto found = finder.find(a, b, reach, way.tuning, device);
      EXPECT_TRUE(std::vector(found.begin(), found.end()) == expected) << way.name << ", reach " << reach;
    }
  }
}

// A mesh that went some way.
struct Moved {
  ClusteredMesh mesh;
  Placement begin;
  MeshWay way{.begin = &begin};

  explicit Moved(const Mesh& shape, Vec3 by) : mesh(tests::clustered(shape)) {
    refit(mesh, tests::translated(shape, by).positions.data());
    begin = mesh.placements().before();
  }
  ClusterBoxes still() const { return {.mesh = &mesh}; }
  ClusterBoxes swept() const { return {.mesh = &mesh, .way = &way}; }
};

// Of one group of clusters and of several, of few and of many.
TEST(ClusterPairs, OfTwoMeshesAreThoseOfALoop) {
  ClusterPairFinder finder;
  EmbreeDevice device;
  for (const int cells : {4, 40, 200}) {
    for (const int subdivisions : {1, 4}) {
      const Moved sheet(tests::wrinkled_sheet(cells, 2.0, 0.3, 1), {0.05, 0, -0.4});
      const Moved ball(tests::icosphere(subdivisions, 0.3), {0.2, 0.1, -0.1});
      expect_pairs_of_loop(sheet.still(), ball.still(), finder, device);
      expect_pairs_of_loop(ball.still(), sheet.still(), finder, device);
      expect_pairs_of_loop(sheet.swept(), ball.swept(), finder, device);
      expect_pairs_of_loop(ball.swept(), sheet.still(), finder, device);
    }
  }
}

TEST(ClusterPairs, OfOneMeshAreThoseOfALoop) {
  ClusterPairFinder finder;
  EmbreeDevice device;
  for (const int cells : {4, 40, 150}) {
    const Moved sheet(tests::wrinkled_sheet(cells, 2.0, 0.3, 1), {0.05, 0, -0.4});
    expect_pairs_of_loop(sheet.still(), sheet.still(), finder, device);
    expect_pairs_of_loop(sheet.swept(), sheet.swept(), finder, device);
  }
}

TEST(ClusterPairs, AreNoneFarAway) {
  ClusterPairFinder finder;
  EmbreeDevice device;
  const ClusteredMesh a = tests::clustered(tests::icosphere(2)),
                      b = tests::clustered(tests::translated(tests::icosphere(2), {4, 0, 0}));
  EXPECT_TRUE(finder.find({.mesh = &a}, {.mesh = &b}, 1.0, base::kTuning, device).empty());
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "narrowphase/mesh/refit.h"
#include "narrowphase/pairs/cluster_pairs.h"
#include "tests/support/generators/fans.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/oracles/reach_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

std::vector<ClusterPair> all_pairs_of(const ClusteredMesh& a, const ClusteredMesh& b) {
  std::vector<ClusterPair> pairs;
  for (int i = 0; i < a.cluster_count(); ++i) {
    for (int k = &a == &b ? i : 0; k < b.cluster_count(); ++k) pairs.push_back({i, k});
  }
  return pairs;
}

std::vector<ClusterPair> left_of(const ClusterBoxes& a, const ClusterBoxes& b, double reach,
                                 const base::Tuning& tuning) {
  std::vector<ClusterPair> pairs = all_pairs_of(*a.mesh, *b.mesh);
  ClusterSeparation separation;
  separation.leave_out({a, a.mesh->cluster_count()}, {b, b.mesh->cluster_count()}, reach, tuning, pairs,
                       std::identity{});
  return pairs;
}

// In which clusters of a mesh the features of some source vertices are: all that use one of them.
bool uses_all(const ClusteredMesh& mesh, int cluster, const std::array<int, 3>& vertices) {
  const auto has = [&](int vertex) {
    for (int f = mesh.facet_begin(cluster); vertex >= 0 && f < mesh.facet_end(cluster); ++f) {
      for (const int v : mesh.corners(f)) {
        if (mesh.source_vertex(v) == vertex) return true;
      }
    }
    return vertex < 0;
  };
  return std::ranges::all_of(vertices, has);
}

// Every two features within reach are in a pair that is left, if they are in one at all.
TEST(ClusterSeparation, LeavesWhatIsWithinReach) {
  const Mesh shapes[] = {tests::fan_cone(120, 0.3), tests::star(300, 3), tests::open_book(200)};
  const base::Tuning always{.worth_planes = 0};
  for (const Mesh& shape : shapes) {
    const ClusteredMesh mesh = tests::clustered(shape);
    for (const double reach : {0.002, 0.02}) {
      const std::vector<ClusterPair> left = left_of({.mesh = &mesh}, {.mesh = &mesh}, reach, always);
      EXPECT_LT(left.size(), all_pairs_of(mesh, mesh).size());
      const auto is_lost = [&](const ClusterPair& pair, const tests::ReachKey& key) {
        const auto& [kind, a, b] = key;
        return !std::ranges::binary_search(left, pair) && ((uses_all(mesh, pair.a, a) && uses_all(mesh, pair.b, b)) ||
                                                           (uses_all(mesh, pair.a, b) && uses_all(mesh, pair.b, a)));
      };
      for (const auto& [key, distance] : tests::own_pairs_within_reach(shape, reach)) {
        for (const ClusterPair& pair : all_pairs_of(mesh, mesh))
          ASSERT_FALSE(is_lost(pair, key)) << "clusters " << pair.a << ", " << pair.b << ", reach " << reach;
      }
    }
  }
}

// Two fans on either side of a short edge, the one around one end of it, the other around the other end: the ends are
// as near as they are, however far apart the fans are beside the edge.
TEST(ClusterSeparation, LeavesFansAtBothEndsOfACommonEdge) {
  constexpr double kEdge = 0.01;
  tests::MeshBuilder builder;
  const int ends[] = {builder.vertex({0.0, 0.0, 0.0}), builder.vertex({0.0, 0.0, kEdge})};
  for (const int side : {0, 1}) {
    const int first = builder.vertex_count();
    for (int i = 0; i < kClusterSize; ++i) builder.vertex({side == 0 ? -1.0 : 1.0, 0.02 * i, 0.0});
    builder.facet(ends[0], ends[1], first);
    for (int i = 1; i < kClusterSize; ++i) builder.facet(ends[side], first + i - 1, first + i);
  }
  const Mesh shape = builder.mesh();
  std::vector<int> order(2 * kClusterSize);
  std::iota(order.begin(), order.end(), 0);
  const ClusteredMesh mesh({shape.positions.data(), static_cast<std::size_t>(shape.positions.size())},
                           {shape.facets.data(), static_cast<std::size_t>(shape.facets.size())}, order);
  const auto left = [&](double reach) { return left_of({.mesh = &mesh}, {.mesh = &mesh}, reach, {.worth_planes = 0}); };
  EXPECT_EQ(left(2.0 * kEdge).size(), 3u);
  EXPECT_EQ(left(0.05 * kEdge).size(), 2u);
}

// Of two tubes side by side that lie across all axes a strip of each is left.
TEST(ClusterSeparation, TellsApartSlivers) {
  tests::Random random(7);
  const tests::Rotation turn = random.rotation();
  const Mesh tube = tests::sliver_tube(1600, 0.1, 4.0);
  const ClusteredMesh a = tests::clustered(tests::rotated(tube, turn)),
                      b = tests::clustered(tests::rotated(tests::translated(tube, {0.202, 0.0, 0.1}), turn));
  EXPECT_EQ(all_pairs_of(a, b).size(), 2500u);
  EXPECT_LE(left_of({.mesh = &a}, {.mesh = &b}, 0.003, base::kTuning).size(), 100u);
  EXPECT_LE(left_of({.mesh = &a}, {.mesh = &a}, 0.0, base::kTuning).size(), 200u);
  EXPECT_EQ(left_of({.mesh = &a}, {.mesh = &b}, 0.003, {.worth_planes = base::Tuning::kNever}).size(), 2500u);
}

// What comes near only between both ends of its way is left.
TEST(ClusterSeparation, SeesTheWholeWay) {
  const Mesh shape = tests::sliver_tube(64, 0.1, 4.0);
  const auto moved = [](const Mesh& from, Vec3 by) {
    ClusteredMesh mesh = tests::clustered(from);
    refit(mesh, tests::translated(from, by).positions.data());
    return mesh;
  };
  const auto left = [](const ClusteredMesh& a, const ClusteredMesh& b) {
    const Placement begin_a = a.placements().before(), begin_b = b.placements().before();
    const MeshWay way_a{.begin = &begin_a}, way_b{.begin = &begin_b};
    return left_of({.mesh = &a, .way = &way_a}, {.mesh = &b, .way = &way_b}, 0.0, {.worth_planes = 0}).size();
  };
  const ClusteredMesh a = moved(shape, {1.0, 0.0, 0.0});
  EXPECT_EQ(left(a, moved(tests::translated(shape, {1.0, 0.0, 0.0}), {-1.0, 0.0, 0.0})), 4u);
  EXPECT_EQ(left(a, moved(tests::translated(shape, {1.0, 0.5, 0.0}), {-1.0, 0.0, 0.0})), 0u);
}

}  // namespace
}  // namespace tact::narrowphase

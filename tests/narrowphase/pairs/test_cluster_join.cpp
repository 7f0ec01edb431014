#include <gtest/gtest.h>

#include "narrowphase/pairs/cluster_join.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;

KeptClusters all_clusters(const ClusteredMesh& mesh) {
  KeptClusters kept;
  keep_clusters({.mesh = &mesh}, 0.0, mesh.box(), kept);
  return kept;
}

TEST(ClusterJoin, LoopAndForestAgree) {
  ClusterJoin join;
  EmbreeDevice device;
  for (const double offset : {0.0, 1e9}) {
    const Mesh sheet = tests::translated(tests::wrinkled_sheet(200, 2.0, 0.3, 1), {offset, 0, 0});
    const ClusteredMesh a = tests::clustered(sheet),
                        b = tests::clustered(tests::translated(tests::icosphere(5, 0.8), {offset, 0, 0.1}));
    const KeptClusters kept_a = all_clusters(a), kept_b = all_clusters(b);
    std::vector<ClusterPair> loop, forest;
    join.run(kept_a, kept_b, BoxPairs::all, tests::kPlain, device, loop);
    EXPECT_FALSE(join.uses_trees());
    join.run(kept_a, kept_b, BoxPairs::all, tests::kForced, device, forest);
    EXPECT_TRUE(join.uses_trees());
    EXPECT_GT(loop.size(), 100u);
    EXPECT_TRUE(loop == forest);
  }
}

// Of a mesh with itself, of few clusters, in runs and by trees.
TEST(ClusterJoin, AscendingPairsAreThoseOfAll) {
  ClusterJoin join;
  EmbreeDevice device;
  for (const int cells : {3, 40, 100, 200}) {
    const ClusteredMesh mesh = tests::clustered(tests::wrinkled_sheet(cells, 2.0, 0.3, 1));
    const KeptClusters kept = all_clusters(mesh);
    for (const base::Tuning& tuning : {tests::kPlain, tests::kForced}) {
      std::vector<ClusterPair> all, ascending;
      join.run(kept, kept, BoxPairs::all, tuning, device, all);
      join.run(kept, kept, BoxPairs::ascending, tuning, device, ascending);
      std::erase_if(all, [](const ClusterPair& pair) { return pair.b < pair.a; });
      EXPECT_TRUE(ascending == all) << cells;
      EXPECT_GE(ascending.size(), kept.cluster.size());
    }
  }
}

#if !defined(TACT_WITHOUT_EMBREE)
TEST(ClusterJoin, EmbreeIsNotStartedByALoop) {
  ClusterJoin join;
  EmbreeDevice device;
  const ClusteredMesh a = tests::clustered(tests::icosphere(3));
  const KeptClusters kept = all_clusters(a);
  std::vector<ClusterPair> pairs;
  join.run(kept, kept, BoxPairs::all, base::kTuning, device, pairs);
  EXPECT_FALSE(device.started());
  join.run(kept, kept, BoxPairs::all, tests::kForced, device, pairs);
  EXPECT_TRUE(device.started());
}
#endif

TEST(ClusterJoin, ExchangesMeshes) {
  ClusterJoin join;
  std::vector<ClusterPair> pairs{{0, 1}, {0, 4}, {2, 0}, {2, 1}, {3, 4}};
  join.exchange_meshes(pairs, 5);
  EXPECT_TRUE(pairs == (std::vector<ClusterPair>{{0, 2}, {1, 0}, {1, 2}, {4, 0}, {4, 3}}));
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <limits>

#include "narrowphase/crossing/facing_clusters.h"
#include "narrowphase/mesh/open_in_box.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

// Of a cluster that is turned away the kernel lists nothing, nor of any cluster of a group that is; of most others it
// lists something. Slivers, whose normals rounding may turn, are never turned away.
TEST(FacingClusters, AreThoseOfWhichTheKernelListsAFacet) {
  Random random(17);
  int turned_away = 0, listed = 0, empty = 0, groups_away = 0;
  for (const tests::Mesh& shape : {tests::icosphere(5), tests::blob(4, 1.0, 0.2, 3), tests::needles(300, 1e8, 4)}) {
    const ClusteredMesh mesh = tests::clustered(shape);
    const auto block_of = [&](int c) {
      FacetBlock block;
      block.count = 0;
      kernels().open_cluster(mesh.facets_of(c), planes_of(everywhere()), &block);
      return block;
    };
    const double scale = 0.25;
    FacingClusters clusters;
    for (int c = 0; c < mesh.cluster_count(); ++c) clusters.add(block_of(c), scale);
    clusters.merge_groups(mesh);
    for (int trial = 0; trial < 40; ++trial) {
      const Vec3 direction = normalized(random.in_cube(1.0));
      const FacingNormals facing{{direction.x, direction.y, direction.z}, trial % 2 == 0 ? 0.5 : 0.05};
      const double at[3] = {0.1, 0.2, 0.3}, most = std::numeric_limits<double>::infinity();
      for (int group = 0; group < mesh.group_count(); ++group) {
        groups_away += clusters.group_turned_away(group, facing);
        for (int c = mesh.cluster_begin(group); c < mesh.cluster_end(group); ++c) {
          FacetDistances found;
          kernels().rank_block(block_of(c), at, scale, most, &facing, &found);
          const bool away = clusters.cluster_turned_away(c, facing);
          EXPECT_TRUE(found.count == 0 || !away) << "cluster " << c << " trial " << trial;
          EXPECT_TRUE(found.count == 0 || !clusters.group_turned_away(group, facing)) << "group " << group;
          turned_away += away;
          listed += found.count > 0;
          empty += found.count == 0 && !away;
        }
      }
    }
  }
  EXPECT_GT(turned_away, 1000);
  EXPECT_GT(listed, 1000);
  EXPECT_LT(2 * empty, turned_away);
  EXPECT_GT(groups_away, 20);
}

// Facets without area, and slivers whose normals are rounding, face anything; others do not.
TEST(FacingClusters, NeverLeaveOutAFacetWhoseNormalIsRounding) {
  for (const double height : {0.0, 1e-14, 0.5}) {
    FacetBlock block{};
    block.count = 1;
    block.upper[0][0] = 1.0;
    block.upper[1][0] = block.normal[2][0] = height;
    FacingClusters clusters;
    clusters.add(block, 1.0);
    EXPECT_EQ(clusters.cluster_turned_away(0, {{0.0, 0.0, -1.0}, 0.5}), height == 0.5) << "height " << height;
  }
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/local_clusters.h"

namespace tact::narrowphase {
namespace {

using tests::LocalCluster;

TEST(RangeAlong, HoldsAllHeightsAndNoMore) {
  const float axis[3] = {0.48f, -0.6f, 0.64f};
  tests::for_clusters([&](const ClusteredMesh& mesh, int cluster) {
    LocalCluster scalar(*scalar_kernels(), mesh, cluster);
    float lowest = 1e30f, highest = -1e30f;
    for (int i = 0; i < scalar.count; ++i) {
      const float height = (axis[0] * scalar.at(0, i) + axis[1] * scalar.at(1, i)) + axis[2] * scalar.at(2, i);
      lowest = height < lowest ? height : lowest;
      highest = height > highest ? height : highest;
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      LocalCluster local(*kernels, mesh, cluster);
      const LocalRange range = kernels->range_along(local.vertices(), local.count, axis);
      EXPECT_EQ(range.lower, lowest) << kernels->name;
      EXPECT_EQ(range.upper, highest) << kernels->name;
    }
  });
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/local_clusters.h"

namespace tact::narrowphase {
namespace {

using tests::LocalCluster;

TEST(Localize, RoundsEachVertexAboutTheOrigin) {
  tests::for_clusters([](const ClusteredMesh& mesh, int cluster) {
    for (const Kernels* kernels : tests::available_kernels()) {
      const LocalCluster local(*kernels, mesh, cluster);
      for (int i = 0; i < local.count; ++i) {
        const bool owned = i < local.facets.owned_count;
        const int vertex = owned ? local.facets.owned_begin + i : local.facets.borrowed[i - local.facets.owned_count];
        for (int axis = 0; axis < 3; ++axis)
          ASSERT_EQ(local.at(axis, i), static_cast<float>(mesh.position(vertex)[axis] - local.origin[axis]))
              << kernels->name;
      }
      for (int i = local.count; i % LocalVertices::kRun != 0; ++i) EXPECT_EQ(local.at(0, i), local.at(0, 0));
    }
  });
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/local_clusters.h"

namespace tact::narrowphase {
namespace {

using tests::LocalCluster;

TEST(MeanNormal, IsTheSameForEveryInstructionSet) {
  tests::for_clusters([](const ClusteredMesh& mesh, int cluster) {
    LocalCluster scalar(*scalar_kernels(), mesh, cluster);
    float expected[3];
    scalar_kernels()->mean_normal(scalar.vertices(), scalar.facets, expected);
    for (const Kernels* kernels : tests::available_kernels()) {
      LocalCluster local(*kernels, mesh, cluster);
      float normal[3];
      kernels->mean_normal(local.vertices(), local.facets, normal);
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(normal[axis], expected[axis]) << kernels->name;
    }
  });
}

TEST(MeanNormal, PointsOutOfASphere) {
  const ClusteredMesh mesh = tests::clustered(tests::icosphere(4));
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    LocalCluster local(kernels(), mesh, c);
    float n[3];
    kernels().mean_normal(local.vertices(), local.facets, n);
    const Vec3 normal = normalized(Vec3{n[0], n[1], n[2]});
    EXPECT_GT(dot(normal, normalized(local.origin)), 0.99);
  }
}

}  // namespace
}  // namespace tact::narrowphase

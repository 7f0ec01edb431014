#include <gtest/gtest.h>

#include <algorithm>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/local_clusters.h"

namespace tact::narrowphase {
namespace {

Vec3 normal_of(const ClusteredMesh& mesh, int facet) {
  const Corners c = mesh.corners(facet);
  return cross(mesh.position(c[1]) - mesh.position(c[0]), mesh.position(c[2]) - mesh.position(c[0]));
}

TEST(NormalSpread, IsThatOfTheFacetsAndTheSameForEveryInstructionSet) {
  int clusters = 0;
  tests::for_clusters([&](const ClusteredMesh& mesh, int cluster) {
    const ClusterFacets facets = mesh.facets_of(cluster);
    const NormalSpread scalar = scalar_kernels()->normal_spread(facets, 0.0);
    for (const Kernels* kernels : tests::available_kernels()) {
      const NormalSpread found = kernels->normal_spread(facets, 0.0);
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(found.axis[axis], scalar.axis[axis]) << kernels->name;
      EXPECT_EQ(found.least, scalar.least) << kernels->name;
    }
    Vec3 sum;
    for (int i = 0; i < facets.facet_count; ++i) sum = sum + normal_of(mesh, facets.facet_begin + i);
    if (scalar.least == 0.0 || norm(sum) < 1e-6) return;
    ++clusters;
    const Vec3 axis{scalar.axis[0], scalar.axis[1], scalar.axis[2]};
    EXPECT_LT(norm(axis - normalized(sum)), 1e-9);
    double least = 1.0;
    for (int i = 0; i < facets.facet_count; ++i) {
      const double cosine = dot(axis, normalized(normal_of(mesh, facets.facet_begin + i)));
      least = std::min(least, cosine * std::abs(cosine));
    }
    EXPECT_NEAR(scalar.least, least, 1e-12);
  });
  EXPECT_GT(clusters, 10);
}

TEST(NormalSpread, OfAFacetWithHardlyAnyAreaThereIsNone) {
  tests::Mesh sheet = tests::sheet(6, 6, 1.0, 1.0);
  const auto least = [&](double sine_squared) {
    const ClusteredMesh mesh = tests::clustered(sheet);
    double all = 1.0;
    for (int c = 0; c < mesh.cluster_count(); ++c) {
      for (const Kernels* kernels : tests::available_kernels())
        all = std::min(all, kernels->normal_spread(mesh.facets_of(c), sine_squared).least);
    }
    return all;
  };
  EXPECT_GT(least(0x1p-40), 0.9);
  EXPECT_EQ(least(0.9), 0.0);
  const int moved = sheet.facets(0, 20), to = sheet.facets(1, 20);
  sheet.positions.col(moved) = sheet.positions.col(to);  // facets of no area
  EXPECT_EQ(least(0x1p-40), 0.0);
}

}  // namespace
}  // namespace tact::narrowphase

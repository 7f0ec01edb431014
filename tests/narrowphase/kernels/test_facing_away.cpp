#include <gtest/gtest.h>

#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::block_of;
using tests::bodies;
using tests::clustered;

// By the normal as it is computed; a facet without area never faces away.
TEST(FacingAway, AgreesWithTheNormals) {
  const HeightAxis axis{0.48, -0.6, 0.64, 0.01, 0.02, -0.03};
  int away = 0, toward = 0;
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = clustered(bodies(seed).second);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, mesh, 0);
      const std::uint64_t found = kernels->facing_away(block, axis);
      for (int f = 0; f < block.count; ++f) {
        const double x = block.normal[0][f], y = block.normal[1][f], z = block.normal[2][f];
        const bool has_area = x != 0.0 || y != 0.0 || z != 0.0;
        const bool expected = has_area && (axis.nx * x + axis.ny * y) + axis.nz * z <= 0.0;
        EXPECT_EQ((found >> f & 1) != 0, expected) << kernels->name << " facet " << f;
        ++(expected ? away : toward);
      }
      EXPECT_EQ(block.count == 64 ? 0 : found >> block.count, 0u) << kernels->name;
    }
  }
  EXPECT_GT(away, 100);
  EXPECT_GT(toward, 100);
}

TEST(FacingAway, AFacetWithoutAreaDoesNot) {
  for (const Kernels* kernels : tests::available_kernels()) {
    FacetBlock block{};
    block.count = 3;
    block.normal[2][1] = 1.0;  // the others have no area
    EXPECT_EQ(kernels->facing_away(block, {0, 0, 1, 0, 0, 0}), 0u) << kernels->name;
    EXPECT_EQ(kernels->facing_away(block, {0, 0, -1, 0, 0, 0}), 2u) << kernels->name;
  }
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/triangles/block_pair.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::all_bits;
using tests::block_of;
using tests::bodies;
using tests::box_of;
using tests::clustered;
using tests::kGrid;
using tests::meeting_in_truth;
using tests::merged;

// Neither a box nor a plane loses a facet that meets one.
TEST(AnyNear, HoldsForEveryFacetThatMeetsOne) {
  for (int seed = 0; seed < 30; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const std::vector<FacetPair> meeting = meeting_in_truth(a, b);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block_a = block_of(*kernels, a, 0), block_b = block_of(*kernels, b, 0);
      for (const FacetPair& pair : meeting) {
        const BoxBounds box = box_of(block_a, static_cast<std::size_t>(pair.a));
        const BoxBounds both = merged(box, box_of(block_b, static_cast<std::size_t>(pair.b)));
        EXPECT_TRUE(kernels->any_near(block_b, std::uint64_t{1} << pair.b, cells_of(kGrid, box), box, both))
            << kernels->name << " seed " << seed;
      }
    }
  }
}

// The square z = 0 of a block against boxes beside it in the same cells: its plane tells.
TEST(AnyNear, APlaneLeavesABoxOnOneSide) {
  FacetBlock block{};
  block.count = block.cells.count = 1;
  const double corner[3][3] = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}};  // the plane z = x + y
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) block.corner[k][axis][0] = corner[k][axis];
  }
  block.normal[0][0] = block.normal[1][0] = -1.0;
  block.normal[2][0] = 1.0;
  for (int axis = 0; axis < 3; ++axis) block.cells.upper[axis][0] = 10;
  const CellBox cells{{0, 0, 0}, {10, 10, 10}};
  const BoxBounds all{{0, 0, 0}, {1, 1, 1}};
  for (const Kernels* kernels : tests::available_kernels()) {
    EXPECT_TRUE(kernels->any_near(block, 1, cells, {{0.2, 0.2, 0.3}, {0.3, 0.3, 0.5}}, all)) << kernels->name;
    EXPECT_FALSE(kernels->any_near(block, 1, cells, {{0.6, 0.6, 0.0}, {0.7, 0.7, 1.0}}, all)) << kernels->name;
    EXPECT_FALSE(kernels->any_near(block, 1, cells, {{0.0, 0.0, 0.5}, {0.1, 0.1, 0.6}}, all)) << kernels->name;
    EXPECT_TRUE(kernels->any_near(block, 1, cells, {{0.0, 0.5, 0.5}, {0.0, 0.6, 0.7}}, all))
        << kernels->name;  // touches
    EXPECT_FALSE(kernels->any_near(block, 1, {{11, 0, 0}, {12, 10, 10}}, all, all)) << kernels->name;
    EXPECT_FALSE(kernels->any_near(block, 0, cells, all, all)) << kernels->name;
  }
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <cstdint>

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
using tests::clustered;
using tests::kGrid;

constexpr BoxBounds kBox{{-0.4, -0.3, -0.5}, {0.5, 0.4, 0.6}};

bool reaches(const FacetBlock& block, int f, const CellBox& cells) {
  for (int axis = 0; axis < 3; ++axis) {
    if (block.cells.upper[axis][f] < cells.lower[axis] || cells.upper[axis] < block.cells.lower[axis][f]) return false;
  }
  return true;
}

TEST(NearFacets, AreTheCandidatesThatReachTheCells) {
  const CellBox cells = cells_of(kGrid, kBox);
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = clustered(bodies(seed).second);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, mesh, 0);
      for (const std::uint64_t candidates :
           {all_bits(block.count), std::uint64_t{0x5a5a5a5a5a5a5a5a}, std::uint64_t{0}}) {
        std::uint64_t expected = 0;
        for (int f = 0; f < block.count; ++f) expected |= std::uint64_t{reaches(block, f, cells)} << f;
        EXPECT_EQ(kernels->near_facets(block.cells, candidates & all_bits(block.count), cells), expected & candidates)
            << kernels->name << " seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(CellsOf, AreThoseThatTheFacetsReach) {
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = clustered(bodies(seed).second);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, mesh, 0);
      for (const std::uint64_t wanted : {all_bits(64), std::uint64_t{1}, std::uint64_t{0x8421084210842108}}) {
        const std::uint64_t facets = wanted & all_bits(block.count);
        if (facets == 0) continue;
        const CellBox cells = kernels->cells_of(block.cells, facets);
        for (int axis = 0; axis < 3; ++axis) {
          std::int16_t first = 0x7fff, last = 0;
          for (int f = 0; f < block.count; ++f) {
            if ((facets >> f & 1) == 0) continue;
            first = std::min(first, block.cells.lower[axis][f]);
            last = std::max(last, block.cells.upper[axis][f]);
          }
          EXPECT_EQ(cells.lower[axis], first) << kernels->name << " seed " << seed;
          EXPECT_EQ(cells.upper[axis], last) << kernels->name << " seed " << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase

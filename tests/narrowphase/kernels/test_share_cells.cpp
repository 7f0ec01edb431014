#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
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
using tests::kNever;
using tests::paired;

// Cells of kGrid, whose coordinates stay within it.
bool boxes_share_cells(const BoxBounds& a, const BoxBounds& b) {
  const auto cell = [](double x) { return std::floor((x + 9.0) / 18.0 * kLastCell); };
  for (int axis = 0; axis < 3; ++axis) {
    if (cell(a.upper[axis]) < cell(b.lower[axis]) || cell(b.upper[axis]) < cell(a.lower[axis])) return false;
  }
  return true;
}

TEST(ShareCells, FindsThePairsOfBoxesThatDo) {
  for (int seed = 0; seed < 12; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const FacetBlock block_a = block_of(*scalar_kernels(), a, 0), block_b = block_of(*scalar_kernels(), b, 0);
    std::vector<FacetPair> sharing;
    for (int f = 0; f < block_a.count; ++f) {
      for (int g = 0; g < block_b.count; ++g) {
        const bool share = boxes_share_cells(box_of(block_a, f), box_of(block_b, g));
        EXPECT_TRUE(share || !overlaps(tests::facet_box(a, f), tests::facet_box(b, g)));
        if (share) sharing.push_back({f, g});
      }
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      for (const bool few_are_b : {false, true}) {
        std::int64_t box_pairs = 0;
        EXPECT_EQ(paired(*kernels, block_a, block_b, few_are_b, kNever, box_pairs), sharing) << kernels->name;
        EXPECT_EQ(box_pairs, static_cast<std::int64_t>(sharing.size()));
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase

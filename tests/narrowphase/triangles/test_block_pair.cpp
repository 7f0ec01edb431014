#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "narrowphase/triangles/block_pair.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"

namespace tact::narrowphase {
namespace {

using tests::all_bits;
using tests::block_of;
using tests::bodies;
using tests::clustered;

// How many facets' boxes overlap one of the other body's.
std::int64_t overlapping_boxes(const ClusteredMesh& a, const ClusteredMesh& b) {
  std::int64_t count = 0;
  for (int f = 0; f < a.facet_end(0); ++f) {
    for (int g = 0; g < b.facet_end(0); ++g) count += overlaps(tests::facet_box(a, f), tests::facet_box(b, g)) ? 1 : 0;
  }
  return count;
}

// A grid over a box of a hundred to a million times the bodies' size: pairs share cells that are farther apart than the
// facets are wide, and what is said of these must be right as well.
TEST(BlockPair, IsRightOfPairsThatOnlyShareCells) {
  std::int64_t asked = 0, overlapping = 0;
  for (int seed = 0; seed < 24; ++seed) {
    for (const double reach : {1.0, 1e2, 1e3, 1e4, 1e6}) {
      const auto [mesh_a, mesh_b] = bodies(seed);
      const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
      const Grid grid = grid_over({{-reach, -reach, -reach}, {reach, reach, reach}}, kLastCell);
      const FacetBlock block_a = block_of(kernels(), a, 0, tests::kAll, grid);
      const FacetBlock block_b = block_of(kernels(), b, 0, tests::kAll, grid);
      BlockPair blocks;
      ConfirmCounts counts;
      std::vector<FacetPair> found;
      blocks.find_meeting(block_a, all_bits(block_a.count), block_b, all_bits(block_b.count),
                          bounds_of(merged(a.box(), b.box())), grid, base::kTuning, found, counts);
      std::sort(found.begin(), found.end());
      asked += counts.facet_box_pairs;
      overlapping += overlapping_boxes(a, b);
      EXPECT_EQ(found, tests::meeting_in_truth(a, b)) << "seed " << seed << ", grid over " << reach;
    }
  }
  EXPECT_GT(asked, 100'000);
  EXPECT_GT(asked - overlapping, 50'000);
}

}  // namespace
}  // namespace tact::narrowphase

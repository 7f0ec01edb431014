#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "narrowphase/block_pair.h"
#include "tests/support/clustered.h"
#include "tests/support/facet_blocks.h"

namespace tact::narrowphase {
namespace {

using tests::all_bits;
using tests::block_of;
using tests::bodies;
using tests::clustered;

// A grid over a box of a hundred to a million times the bodies' size: pairs share cells that are farther apart than the
// facets are wide, and what is said of these must be right as well.
TEST(BlockPair, IsRightOfPairsThatOnlyShareCells) {
  int asked = 0, apart = 0;
  for (int seed = 0; seed < 24; ++seed) {
    for (const double reach : {1.0, 1e2, 1e3, 1e4, 1e6}) {
      const auto [mesh_a, mesh_b] = bodies(seed);
      const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
      const Grid grid = grid_over({{-reach, -reach, -reach}, {reach, reach, reach}}, kLastCell);
      const FacetBlock block_a = block_of(kernels(), a, 0, tests::kAll, grid);
      const FacetBlock block_b = block_of(kernels(), b, 0, tests::kAll, grid);
      const std::uint64_t of_a = all_bits(block_a.count), of_b = all_bits(block_b.count);
      BlockPair blocks;
      blocks.begin(block_a, of_a, block_b, of_b, bounds_of(merged(a.box(), b.box())), grid);
      ConfirmCounts counts;
      std::vector<FacetPair> found;
      for (std::uint64_t left = of_a; left != 0;) {
        FacetPairList pairs;
        left =
            kernels()
                .pair_facets(block_a, left, block_b, of_b, tests::kEverything, false, FacetBlock::kCapacity + 1, &pairs)
                .left_over;
        asked += pairs.count;
        const std::uint64_t meeting = blocks.meeting(pairs, counts);
        for (int k = 0; k < pairs.count; ++k) {
          if (!overlaps(tests::facet_box(a, pairs.a[k]), tests::facet_box(b, pairs.b[k]))) ++apart;
          if ((meeting >> k & 1) != 0) found.push_back({pairs.a[k], pairs.b[k]});
        }
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, tests::meeting_in_truth(a, b)) << "seed " << seed << ", grid over " << reach;
    }
  }
  EXPECT_GT(asked, 100'000);
  EXPECT_GT(apart, 50'000);
}

}  // namespace
}  // namespace tact::narrowphase

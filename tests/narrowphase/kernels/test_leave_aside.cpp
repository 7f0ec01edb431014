#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

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
using tests::kAlways;
using tests::kNever;
using tests::meeting_in_truth;
using tests::paired;

// Planes remove many pairs, no pair that meets, and the same for every instruction set.
TEST(LeaveAside, LosesNoPairThatMeets) {
  std::size_t left_aside = 0;
  for (int seed = 0; seed < 30; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const std::vector<FacetPair> meeting = meeting_in_truth(a, b);
    const FacetBlock scalar_a = block_of(*scalar_kernels(), a, 0), scalar_b = block_of(*scalar_kernels(), b, 0);
    for (const bool few_are_b : {false, true}) {
      std::int64_t box_pairs = 0;
      const std::vector<FacetPair> all = paired(*scalar_kernels(), scalar_a, scalar_b, few_are_b, kNever, box_pairs);
      for (const int plane_from : {kAlways, 6}) {
        const std::vector<FacetPair> expected =
            paired(*scalar_kernels(), scalar_a, scalar_b, few_are_b, plane_from, box_pairs);
        EXPECT_TRUE(std::includes(all.begin(), all.end(), expected.begin(), expected.end()));
        EXPECT_TRUE(std::includes(expected.begin(), expected.end(), meeting.begin(), meeting.end())) << "seed " << seed;
        left_aside += all.size() - expected.size();
        for (const Kernels* kernels : tests::available_kernels()) {
          EXPECT_EQ(
              paired(*kernels, block_of(*kernels, a, 0), block_of(*kernels, b, 0), few_are_b, plane_from, box_pairs),
              expected)
              << kernels->name << " seed " << seed << " plane from " << plane_from;
        }
      }
    }
  }
  EXPECT_GT(left_aside, 1000u);
}

}  // namespace
}  // namespace tact::narrowphase

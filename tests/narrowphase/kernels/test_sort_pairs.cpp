#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

TEST(SortPairs, SortsAnyNumberOfThem) {
  tests::Random random(3);
  for (int count = 0; count <= kMostSorted; ++count) {
    std::vector<FacetPair> sorted, shuffled;
    for (int i = 0; i < count; ++i) sorted.push_back({i / 5 * 70'000'000, 2'147'483'640 + i % 5});
    std::sort(sorted.begin(), sorted.end());
    shuffled = sorted;
    for (std::size_t i = shuffled.size(); i > 1; --i) {
      std::swap(shuffled[i - 1], shuffled[random.below(static_cast<int>(i))]);
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::vector<FacetPair> pairs = shuffled;
      kernels->sort_pairs(pairs.data(), count);
      EXPECT_EQ(pairs, sorted) << kernels->name;
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "engine/pair/facet_pair_sort.h"
#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"

namespace tact {
namespace {

// Few are sorted by a kernel, many by their digits; the largest numbers fill all bits of a key.
TEST(FacetPairSort, SortsFewAndManyPairsWhateverTheirNumbers) {
  base::KeySorter sorter;
  tests::Random random(5);
  for (const std::size_t count : {0, 1, narrowphase::kMostSorted, narrowphase::kMostSorted + 1, 5000}) {
    for (const auto& [facets_a, facets_b] : {std::pair{6000, 90}, {1 << 12, 1 << 12}, {(1 << 29) - 1, (1 << 29) - 1}}) {
      std::set<std::pair<int, int>> drawn;
      drawn.insert({facets_a - 1, facets_b - 1});
      while (drawn.size() < count) drawn.insert({random.below(facets_a), random.below(facets_b)});
      if (count == 0) drawn.clear();
      std::vector<FacetPair> expected;
      for (const auto& [a, b] : drawn) expected.push_back({a, b});
      for (const int threads : {1, 2}) {
        std::vector<FacetPair> pairs;
        for (const int i : random.permutation(static_cast<int>(expected.size()))) pairs.push_back(expected[i]);
        sort_facet_pairs(pairs, facets_a, facets_b, sorter, threads);
        EXPECT_TRUE(pairs == expected) << count << " pairs of " << facets_a << " and " << facets_b << " facets";
      }
    }
  }
}

}  // namespace
}  // namespace tact

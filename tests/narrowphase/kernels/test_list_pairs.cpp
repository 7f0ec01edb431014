#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_blocks.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::Met;

// Some facets of the few, each with any number of others, up to all 64: every pair is listed once, in full lists.
TEST(ListPairs, ListsEveryPairOnce) {
  tests::Random random(14);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const std::uint64_t some = random.bits() & random.bits();
    Met met{};
    std::vector<FacetPair> expected;
    for (int f = 0; f < 64; ++f) {
      met[f] = repeat % 7 == 0 ? ~std::uint64_t{0} : random.bits() & random.bits() & random.bits();
      for (int g = 0; g < 64; ++g) {
        if ((some >> f & 1) != 0 && (met[f] >> g & 1) != 0) expected.push_back({f, g});
      }
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      for (const bool few_are_b : {false, true}) {
        Met left_of = met;
        std::vector<FacetPair> listed;
        for (std::uint64_t left = some; left != 0;) {
          FacetPairList pairs;
          left = kernels->list_pairs(left, left_of.data(), few_are_b, &pairs);
          ASSERT_TRUE(left == 0 || pairs.count == FacetPairList::kCapacity) << kernels->name;
          ASSERT_EQ(left & ~some, 0u);
          for (int k = 0; k < pairs.count; ++k)
            listed.push_back(few_are_b ? FacetPair{pairs.b[k], pairs.a[k]} : FacetPair{pairs.a[k], pairs.b[k]});
        }
        EXPECT_EQ(listed, expected) << kernels->name;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase

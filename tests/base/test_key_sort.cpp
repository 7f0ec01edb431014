#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/base/key_sort.h"
#include "tests/support/generators/random.h"

namespace tact::base {
namespace {

TEST(KeySort, SortsLikeTheStandardLibrary) {
  KeySorter sorter;
  for (const int bits : {1, 7, 8, 9, 24, 33, 63}) {
    for (const std::size_t count : {0, 1, 2, 129, 5000, 40000}) {
      tests::Random random(static_cast<std::uint64_t>(bits) * 100000 + count);
      std::vector<std::uint64_t> expected(count);
      for (std::uint64_t& key : expected) key = random.bits() >> (64 - bits);
      for (const int threads : {1, 2, 3}) {
        std::ranges::copy(expected, sorter.keys(count).begin());
        std::vector<std::uint64_t> in_order = expected;
        std::ranges::sort(in_order);
        EXPECT_TRUE(std::ranges::equal(sorter.sort(bits, threads), in_order))
            << count << " keys of " << bits << " bits, " << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace tact::base

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "broadphase/pair_sort.h"
#include "tests/support/generators/random.h"

namespace tact::broadphase {
namespace {

std::vector<PairList> random_parts(std::uint64_t seed, std::size_t count, std::uint32_t index_count) {
  tests::Random random(seed);
  std::vector<PairList> parts(5);
  for (std::size_t i = 0; i < count; ++i) {
    const auto a = static_cast<std::uint32_t>(random.bits() % index_count);
    const auto b = static_cast<std::uint32_t>(random.bits() % index_count);
    PairList& part = parts[random.bits() % 4];  // one stays empty
    *part.room(1) = {std::min(a, b), std::max(a, b)};
    part.extend(1);
  }
  return parts;
}

TEST(PairSort, SortsLikeTheStandardLibrary) {
  PairSorter sorter;
  for (const std::uint32_t index_count : {1u, 2u, 3u, 255u, 256u, 5000u, 1u << 20, 0xfffffff0u}) {
    for (const std::size_t count : {0, 1, 2, 100, 70000}) {
      const std::vector<PairList> parts = random_parts(index_count + count, count, index_count);
      std::vector<IndexPair> expected;
      for (const PairList& part : parts) expected.insert(expected.end(), part.pairs().begin(), part.pairs().end());
      std::ranges::sort(expected);
      for (const int threads : {1, 2, 5}) {
        EXPECT_TRUE(std::ranges::equal(sorter.sort(parts, index_count, threads), expected))
            << count << " pairs of " << index_count << ", " << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace tact::broadphase

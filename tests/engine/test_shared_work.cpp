// The scheduler of a stage: each cluster pair of each item is searched once, whoever does it, and gathered in order.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/shared_work.h"

namespace tact::tests {
namespace {

using narrowphase::ClusterPair;

// `clusters` clusters of A, the i-th of them near 1 + i % 3 of B.
std::vector<ClusterPair> pairs_of(int clusters) {
  std::vector<ClusterPair> pairs;
  for (int a = 0; a < clusters; ++a) {
    for (int b = 0; b <= a % 3; ++b) pairs.push_back({a, b});
  }
  return pairs;
}

TEST(SharedWork, RangesEndBetweenTwoClustersOfA) {
  const std::vector<ClusterPair> pairs = pairs_of(40);
  for (const std::size_t count : {1u, 2u, 7u, 64u, 200u}) {
    EXPECT_EQ(range_begin(pairs, 0, count), 0u);
    EXPECT_EQ(range_begin(pairs, count, count), pairs.size());
    for (std::size_t i = 1; i < count; ++i) {
      const std::size_t begin = range_begin(pairs, i, count);
      EXPECT_GE(begin, range_begin(pairs, i - 1, count));
      if (begin > 0 && begin < pairs.size()) {
        EXPECT_NE(pairs[begin].a, pairs[begin - 1].a);
      }
    }
  }
}

TEST(SharedWork, ARangeHasAsMuchToDoAsIsWorthAThread) {
  const base::Tuning& tuning = base::kTuning;
  EXPECT_EQ(count_of_ranges(1, 8, tuning), 1u);
  EXPECT_EQ(count_of_ranges(1'000'000, 8, tuning), 8 * tuning.ranges_per_thread);
  for (std::size_t work = 1; work < 5000; work += 37) {
    for (const int threads : {1, 2, 3, 16}) {
      const std::size_t ranges = count_of_ranges(work, threads, tuning);
      EXPECT_TRUE(ranges == 1 || work / ranges >= tuning.fewest_in_range) << work << " on " << threads;
    }
  }
  EXPECT_FALSE(is_large(1'000'000, 1, 1, tuning));
  EXPECT_TRUE(is_large(tuning.large_of_few + 1, 1, 2, tuning));
  EXPECT_FALSE(is_large(tuning.large_of_few + 1, 1000, 2, tuning));
}

// Items of which every third is put aside; what is gathered is the sum of what was searched, in order.
TEST(SharedWork, SearchesEachPairOnceAndGathersInOrder) {
  struct Item {
    std::size_t number = 0;
    std::vector<ClusterPair> pairs;
  };
  using Work = SharedWork<Item, std::vector<int>>;
  constexpr std::size_t kItems = 50;
  Work work;
  for (const int threads : {1, 2, 4, 3}) {
    std::vector<std::vector<int>> found(kItems);
    std::vector<Item> memory(threads);
    const auto append = [](std::span<const ClusterPair> pairs, std::vector<int>& to) {
      for (const ClusterPair& pair : pairs) to.push_back(pair.a);
    };
    const auto search = [&](const Work::Shared& shared, Work::Range& range, int) {
      range.found.clear();
      append(std::span(shared.item.pairs).subspan(range.begin, range.end - range.begin), range.found);
    };
    const auto prepare = [&](std::size_t i, int thread) {
      Item& item = memory[thread];
      item.number = i;
      item.pairs = pairs_of(static_cast<int>(i));
      if (i % 3 == 0) {
        work.put_aside(item, item.pairs, 1 + i % 8);
      } else {
        append(item.pairs, found[i]);
      }
    };
    work.begin();
    work.prepare(kItems, 2, threads, true, prepare, search);
    work.search(threads, search);
    EXPECT_EQ(work.items().size(), (kItems + 2) / 3);
    work.gather(threads, [&](const Work::Shared& shared, int, int) {
      std::vector<int>& of_item = found[shared.item.number];
      EXPECT_TRUE(of_item.empty());
      for (const Work::Range& range : work.ranges(shared))
        of_item.insert(of_item.end(), range.found.begin(), range.found.end());
    });
    for (std::size_t i = 0; i < kItems; ++i) {
      std::vector<int> expected;
      append(pairs_of(static_cast<int>(i)), expected);
      EXPECT_EQ(found[i], expected) << "item " << i << ", " << threads << " threads";
    }
  }
}

TEST(SharedWork, BeginsRangesInTheOrderOfAKey) {
  using Work = SharedWork<std::size_t, double>;
  Work work;
  work.begin();
  const std::vector<ClusterPair> pairs = pairs_of(30);
  for (std::size_t i = 0; i < 4; ++i) {
    std::size_t item = i;
    const Work::Shared& shared = work.put_aside(item, pairs, 5);
    double key = static_cast<double>(10 * (i % 2));
    for (Work::Range& range : work.ranges(shared)) range.found = key++;
  }
  std::vector<std::pair<double, std::size_t>> order;
  work.search_by(
      [](const Work::Range& range) { return range.found; }, 1,
      [&](const Work::Shared& shared, const Work::Range& range, int) { order.emplace_back(range.found, shared.item); });
  EXPECT_EQ(order.size(), work.range_count());
  EXPECT_TRUE(std::ranges::is_sorted(order));
}

TEST(SharedWork, AnItemLargerThanAThreadsPartIsAllThreads) {
  const std::vector<std::size_t> sizes = {1, 100, 3, 60, 2};
  for (const int threads : {1, 2, 4}) {
    std::vector<std::atomic<int>> given(sizes.size());
    for_each_item(
        sizes.size(), threads, [&](std::size_t i) { return sizes[i]; },
        [&](std::size_t i, int, int threads_of_item) { given[i] += threads_of_item; });
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const bool alone = static_cast<std::size_t>(threads) * sizes[i] > 166;
      EXPECT_EQ(given[i], alone ? threads : 1) << "item " << i << ", " << threads << " threads";
    }
  }
}

// Whichever threads come first, and though the largest item is done before the others.
TEST(SharedWork, ThrowsWhatTheFirstItemThrew) {
  const std::vector<std::size_t> sizes = {1, 2, 1, 100, 1};
  for (const int threads : {1, 2, 4}) {
    try {
      for_each_item(
          sizes.size(), threads, [&](std::size_t i) { return sizes[i]; },
          [&](std::size_t i, int, int) {
            if (i > 0) throw std::runtime_error(std::to_string(i));
          });
      FAIL() << threads << " threads";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "1") << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace tact::tests

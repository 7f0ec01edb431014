#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "broadphase/block_join.h"
#include "tests/support/generators/box_workloads.h"
#include "tests/support/oracles/box_pairs.h"

namespace tact::broadphase {
namespace {

std::vector<IndexPair> sorted_pairs(std::span<const PairList> lists) {
  std::vector<IndexPair> pairs;
  for (const PairList& list : lists) pairs.insert(pairs.end(), list.pairs().begin(), list.pairs().end());
  std::ranges::sort(pairs);
  return pairs;
}

TEST(BlockJoin, FindsThePairsOfBoxesThatChanged) {
  for (const tests::BoxWorkloadKind kind : tests::all_box_workloads()) {
    tests::BoxWorkload workload(kind, 700, 21);
    BlockTree tree;
    BlockJoin join;
    for (int step = 0; step < 5; ++step) {
      if (step > 0) workload.step();
      std::vector<std::uint8_t> is_changed(workload.boxes().size());
      for (const std::uint32_t index : workload.changed()) is_changed[index] = 1;
      tree.update(workload.boxes(), workload.changed(), is_changed, 1);
      std::vector<IndexPair> expected = tests::all_overlapping_pairs(workload.boxes(), workload.filters());
      std::erase_if(expected, [&](IndexPair pair) { return !is_changed[pair.a] && !is_changed[pair.b]; });
      for (int threads = 1; threads <= (step == 4 ? 2 : 1); ++threads) {
        EXPECT_TRUE(sorted_pairs(join.run(tree, workload.boxes(), workload.filters(), threads)) == expected)
            << name_of(kind) << ", step " << step << ", threads " << threads;
      }
    }
  }
}

TEST(BlockJoin, CountsPairsThatFiltersDrop) {
  const std::vector<Box> boxes(40, Box{{0, 0, 0}, {1, 1, 1}});
  std::vector<Filter> filters(boxes.size());
  for (std::size_t i = 0; i < 10; ++i) filters[i].fixed = true;
  std::vector<std::uint32_t> changed(boxes.size());
  for (std::uint32_t i = 0; i < changed.size(); ++i) changed[i] = i;
  BlockTree tree;
  tree.update(boxes, changed, std::vector<std::uint8_t>(boxes.size(), 1), 1);
  BlockJoin join;
  const std::vector<IndexPair> found = sorted_pairs(join.run(tree, boxes, filters, 1));
  EXPECT_EQ(found.size(), 40u * 39 / 2 - 10 * 9 / 2);
  EXPECT_EQ(join.excluded(), 10u * 9 / 2);
  EXPECT_GT(join.visits(), 0u);
}

}  // namespace
}  // namespace tact::broadphase

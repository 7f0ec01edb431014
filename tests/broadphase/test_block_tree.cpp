#include <gtest/gtest.h>

#include <vector>

#include "broadphase/block_join.h"
#include "broadphase/block_tree.h"
#include "tests/support/generators/box_workloads.h"

namespace tact::broadphase {
namespace {

using tests::BoxWorkload;
using tests::BoxWorkloadKind;

// A tree and the work of finding its pairs, in comparisons of two blocks.
class Follower {
 public:
  std::size_t update(const BoxWorkload& workload) {
    std::vector<std::uint8_t> is_changed(workload.boxes().size());
    for (const std::uint32_t index : workload.changed()) is_changed[index] = 1;
    tree_.update(workload.boxes(), workload.changed(), is_changed, 1);
    join_.run(tree_, workload.boxes(), {}, 1);
    tree_.note_cost(join_.visits(), workload.changed().size());
    return join_.visits();
  }
  const BlockTree& tree() const { return tree_; }

 private:
  BlockTree tree_;
  BlockJoin join_;
};

TEST(BlockTree, ValidatesOverSteps) {
  for (const BoxWorkloadKind kind : tests::all_box_workloads()) {
    BoxWorkload workload(kind, 3000, 12);
    Follower follower;
    for (int step = 0; step < 100; ++step) {
      if (step > 0) workload.step();
      follower.update(workload);
      ASSERT_TRUE(follower.tree().validate(workload.boxes())) << name_of(kind) << ", step " << step;
    }
  }
}

TEST(BlockTree, ValidateFindsABoxThatWasNotListed) {
  BoxWorkload workload(BoxWorkloadKind::small_motion, 1000, 12);
  Follower follower;
  follower.update(workload);
  std::vector<Box> boxes(workload.boxes().begin(), workload.boxes().end());
  ASSERT_TRUE(follower.tree().validate(boxes));
  boxes[500].upper.z += 0.25;
  EXPECT_FALSE(follower.tree().validate(boxes));
  boxes.pop_back();
  EXPECT_FALSE(follower.tree().validate(boxes));
}

// After any history the work stays near that of a fresh start.
TEST(BlockTree, TheOrderDoesNotWearOut) {
  for (const BoxWorkloadKind kind : tests::all_box_workloads()) {
    BoxWorkload workload(kind, 5000, 13);
    Follower carried;
    for (int step = 0; step < 400; ++step) {
      if (step > 0) workload.step();
      const std::size_t visits = carried.update(workload);
      if (step % 50 != 49) continue;
      BoxWorkload whole = workload;
      whole.mark_all();
      Follower fresh;
      EXPECT_LE(visits, 3 * fresh.update(whole)) << name_of(kind) << ", step " << step;
    }
  }
}

// Work is in proportion to boxes and overlaps, on every workload: eight times the boxes, at most 8 * 1.3 times the
// work.
TEST(BlockTree, WorkGrowsInProportion) {
  for (const BoxWorkloadKind kind : tests::all_box_workloads()) {
    Follower small;
    Follower large;
    const auto few = static_cast<double>(small.update(BoxWorkload(kind, 8000, 14)));
    const auto many = static_cast<double>(large.update(BoxWorkload(kind, 64000, 14)));
    EXPECT_LE(many, 8 * 1.3 * few) << name_of(kind);
  }
}

TEST(BlockTree, AFewChangedBoxesCostLittle) {
  BoxWorkload workload(BoxWorkloadKind::few_moving, 50000, 15);
  Follower follower;
  const std::size_t first = follower.update(workload);
  workload.step();
  EXPECT_LT(follower.update(workload), first / 20);
}

}  // namespace
}  // namespace tact::broadphase

// What a broad phase allocates. operator new is replaced for the whole test program.
#include <gtest/gtest.h>

#include <vector>

#include "broadphase/sweep_and_prune.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/box_workloads.h"

namespace tact::broadphase {
namespace {

// The same frames again and again: after the first rounds all memory is there.
TEST(Allocation, ASteadyStateAllocatesNothing) {
  for (const tests::BoxWorkloadKind kind : tests::all_box_workloads()) {
    tests::BoxWorkload workload(kind, 3000, 21);
    std::vector<std::vector<Box>> frames;
    for (int i = 0; i < 4; ++i, workload.step()) frames.emplace_back(workload.boxes().begin(), workload.boxes().end());
    workload.mark_all();
    SweepAndPrune sweep;
    for (int round = 0; round < 80; ++round) {
      const long before = tests::allocation_count();
      for (const auto& boxes : frames)
        sweep.update(boxes, workload.filters(), workload.changed(), round % 20 == 0 ? 2 : 1);
      const long after = tests::allocation_count();
      if (round < 60) continue;
      EXPECT_EQ(after, before) << name_of(kind) << ", round " << round;
    }
  }
}

}  // namespace
}  // namespace tact::broadphase

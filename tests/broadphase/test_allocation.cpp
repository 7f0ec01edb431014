// Counts what the program allocates. The operators below hold for the whole test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "broadphase/sweep_and_prune.h"
#include "tests/support/generators/box_workloads.h"

namespace {

std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

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
      const std::size_t before = allocations;
      for (const auto& boxes : frames)
        sweep.update(boxes, workload.filters(), workload.changed(), round % 20 == 0 ? 2 : 1);
      const std::size_t after = allocations;
      if (round < 60) continue;
      EXPECT_EQ(after, before) << name_of(kind) << ", round " << round;
    }
  }
}

}  // namespace
}  // namespace tact::broadphase

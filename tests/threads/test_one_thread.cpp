// Settings::threads = 1 means one thread, Embree's included.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator());
}

TEST(OneThread, StaysAloneAndTakesNoMoreProcessorTimeThanPasses) {
  if (!std::filesystem::exists("/proc/self/task")) GTEST_SKIP() << "no /proc/self/task to count threads in";
  const std::ptrdiff_t threads_before = threads_of_this_process();
  const std::clock_t cpu_begin = std::clock();
  const auto begin = std::chrono::steady_clock::now();
  World world({.threads = 1});
  const Mesh a = wrinkled_sheet(200, 2.0, 0.05, 1), b = wrinkled_sheet(200, 2.0, 0.05, 2);
  const std::vector<BodyId> ids = add_bodies(world, std::array{a, b, icosphere(3)});
  for (int step = 0; step < 10; ++step) {
    world.set_positions(ids[0], translated(a, {0.0, 0.0, 0x1p-12 * step}).positions);
    EXPECT_EQ(world.detect().stats().tree_pairs, 1);  // Embree is at work
    EXPECT_EQ(threads_of_this_process(), threads_before);
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double cpu = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
  EXPECT_LE(cpu, 1.02 * wall + 0.02);  // the clocks' steps
}

}  // namespace
}  // namespace tact::tests

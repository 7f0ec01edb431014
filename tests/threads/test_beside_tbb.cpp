// Worlds beside a program's own TBB, which Embree uses too.
#include <gtest/gtest.h>
#include <tact/tact.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"

namespace tact::tests {
namespace {

// Steps of a crowd, and of two bodies whose cluster pairs Embree's trees find.
std::vector<std::uint64_t> hashes_of_steps(std::uint64_t seed, int threads) {
  World world({.threads = threads});
  std::vector<Mesh> bodies = crowd_of_blobs(12, seed);
  bodies.push_back(translated(icosphere(6), {20.0, 0.0, 0.0}));
  bodies.push_back(translated(scaled(icosphere(6), 0.98), {20.03, 0.01, 0.0}));
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  std::vector<std::uint64_t> hashes;
  for (int step = 0; step < 3; ++step) {
    const Report& report = world.detect();
    EXPECT_EQ(report.stats().tree_pairs, 1);
    hashes.push_back(report.hash());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i] = translated(bodies[i], {0.03125, 0.0, 0.015625 * static_cast<double>(i % 3)});
      world.set_positions(ids[i], bodies[i].positions);
    }
  }
  return hashes;
}

TEST(BesideTbb, WorldsInsideTasksAnswerAsAlone) {
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
  GTEST_SKIP() << "TBB is not instrumented: the thread sanitizer does not see that a task has ended";
#endif
#endif
  std::array<std::vector<std::uint64_t>, 4> found;
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) { found[i] = hashes_of_steps(i, 2); });
  for (std::uint64_t seed = 0; seed < found.size(); ++seed) EXPECT_EQ(found[seed], hashes_of_steps(seed, 1)) << seed;
}

// The calling thread belongs to an arena, whose other tasks run while it steps.
TEST(BesideTbb, WorldInAnArenaThatIsBusyAnswersAsAlone) {
  const std::vector<std::uint64_t> expected = hashes_of_steps(7, 1);
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> work{0};
  std::vector<std::uint64_t> found;
  tbb::task_arena arena(3);
  arena.execute([&] {
    tbb::task_group others;
    for (int i = 0; i < 2; ++i) {
      others.run([&] {
        while (!done) ++work;
      });
    }
    found = hashes_of_steps(7, 2);
    done = true;
    others.wait();
  });
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace tact::tests

// Worlds on the threads of a program: the same bits, whatever the executor makes of its tasks.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "examples/executors/thread_pool.h"
#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"

namespace tact::tests {
namespace {

std::vector<std::uint64_t> hashes_of_steps(const Settings& settings) {
  World world(settings);
  std::vector<Mesh> bodies = crowd_of_blobs(24, 5);
  bodies.push_back(translated(icosphere(6), {20.0, 0.0, 0.0}));
  bodies.push_back(translated(scaled(icosphere(6), 0.98), {20.03, 0.01, 0.0}));
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  std::vector<std::uint64_t> hashes;
  for (int step = 0; step < 3; ++step) {
    hashes.push_back(world.detect().hash());
    std::vector<PositionsUpdate> updates;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i] = translated(bodies[i], {0.03125, 0.0, 0.015625 * static_cast<double>(i % 3)});
      updates.push_back({ids[i], bodies[i].positions});
    }
    world.set_positions(updates);
  }
  return hashes;
}

// An executor that does with its tasks what a function says.
class Doing : public Executor {
 public:
  using Function = std::function<void(int count, const Task& task)>;
  explicit Doing(Function function) : function_(std::move(function)) {}
  void run(int count, const Task& task) noexcept override {
    ++calls_;
    function_(count, task);
  }
  int calls() const { return calls_; }

 private:
  Function function_;
  int calls_ = 0;
};

void expect_same_as_alone(const Doing::Function& function) {
  const auto executor = std::make_shared<Doing>(function);
  EXPECT_EQ(hashes_of_steps({.threads = 4, .executor = executor}), hashes_of_steps({.threads = 1}));
  EXPECT_GT(executor->calls(), 0);
}

TEST(Executors, OfThreadsGiveTheSameBits) {
  const auto expected = hashes_of_steps({.threads = 1});
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(hashes_of_steps({.threads = threads, .executor = std::make_shared<ThreadPool>(3)}), expected) << threads;
  }
}

TEST(Executors, MayRunTasksOneAfterTheOtherInAnyOrder) {
  expect_same_as_alone([](int count, const Executor::Task& task) {
    while (count-- > 0) task(count);
  });
}

TEST(Executors, MayRunEachTaskOnANewThread) {
  expect_same_as_alone([](int count, const Executor::Task& task) {
    std::vector<std::jthread> threads;
    for (int k = 0; k < count; ++k) threads.emplace_back([&task, k] { task(k); });
  });
}

// Wrong, and yet the answer is right.
TEST(Executors, ThatLeaveTasksOutOrCallThemTwiceDoNoHarm) {
  expect_same_as_alone([](int, const Executor::Task&) {});
  expect_same_as_alone([](int count, const Executor::Task& task) {
    for (const int index : {count - 1, count - 1, -1, count, 1 << 20}) task(index);
  });
}

TEST(Executors, AreCalledOnlyByTheirWorldsAndLetGoWithThem) {
  const auto executor = std::make_shared<Doing>([](int, const Executor::Task&) {});
  {
    World world({.threads = 2, .executor = executor});
    add_bodies(world, crowd_of_blobs(24, 5));
    world.detect();
    const int calls = executor->calls();
    EXPECT_GT(calls, 0);
    hashes_of_steps({.threads = 2});
    EXPECT_EQ(executor->calls(), calls);
    Settings settings = world.settings();
    settings.executor = nullptr;
    world.set_settings(settings);
    world.detect();
    EXPECT_EQ(executor->calls(), calls);
  }
  EXPECT_EQ(executor.use_count(), 1);
}

}  // namespace
}  // namespace tact::tests

// The pool that does the work where OpenMP was left out: each index once, also from many threads at once, and nested.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "engine/base/thread_pool.h"

namespace tact::base {
namespace {

struct Counted {
  std::vector<std::atomic<int>> calls;
  explicit Counted(int count) : calls(static_cast<std::size_t>(count)) {}

  static void add(void* data, int index) { ++static_cast<Counted*>(data)->calls[static_cast<std::size_t>(index)]; }
  bool once_each() const {
    for (const std::atomic<int>& calls_of_index : calls) {
      if (calls_of_index != 1) return false;
    }
    return true;
  }
};

TEST(ThreadPool, CallsEachIndexOnce) {
  ThreadPool pool;
  for (int round = 0; round < 300; ++round) {
    for (const int count : {1, 2, 3, 7}) {
      Counted counted(count);
      pool.run(count, Executor::Task(Counted::add, &counted));
      ASSERT_TRUE(counted.once_each()) << count;
    }
  }
}

TEST(ThreadPool, IsSharedByManyThreads) {
  ThreadPool pool;
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 6; ++k) {
    threads.emplace_back([&] {
      for (int round = 0; round < 200; ++round) {
        Counted counted(4);
        pool.run(4, Executor::Task(Counted::add, &counted));
        if (!counted.once_each()) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

struct Nested {
  ThreadPool& pool;
  std::atomic<int> wrong = 0;

  static void run(void* data, int) {
    Nested& self = *static_cast<Nested*>(data);
    Counted counted(3);
    self.pool.run(3, Executor::Task(Counted::add, &counted));
    if (!counted.once_each()) ++self.wrong;
  }
};

TEST(ThreadPool, TasksMayUseItThemselves) {
  ThreadPool pool;
  Nested nested{pool};
  for (int round = 0; round < 50; ++round) pool.run(5, Executor::Task(Nested::run, &nested));
  EXPECT_EQ(nested.wrong, 0);
}

}  // namespace
}  // namespace tact::base

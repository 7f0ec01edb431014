#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/parallel.h"

namespace {

using tact::base::parallel_for;

// Waits, for ten seconds at most.
template <class Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  return condition();
}

TEST(ParallelFor, VisitsEveryItemOnce) {
  for (const int threads : {1, 2, 8, 40}) {
    for (const std::size_t count : {0u, 1u, 2u, 63u, 64u, 65u, 1000u}) {
      for (const std::size_t grain : {1u, 7u, 64u}) {
        std::vector<std::atomic<int>> visits(count);
        parallel_for(count, grain, threads, [&](std::size_t i) { ++visits[i]; });
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(visits[i], 1) << "item " << i << " of " << count << ", grain " << grain << ", threads " << threads;
        }
      }
    }
  }
}

TEST(ParallelFor, CallsAfterwardsOnceForEachOfSeveralThreads) {
  std::array<std::atomic<int>, 3> calls{};
  parallel_for(
      100, 1, 3, [](std::size_t) {}, [&](int thread) { ++calls[static_cast<std::size_t>(thread)]; });
  for (const std::atomic<int>& of_thread : calls) EXPECT_EQ(of_thread, 1);
  parallel_for(
      100, 1, 1, [](std::size_t) {}, [&](int) { ++calls[0]; });
  EXPECT_EQ(calls[0], 1);
}

TEST(ParallelFor, ThrowsWhatAfterwardsThrowsUnlessAnItemDid) {
  const auto fail = [](int) { throw std::runtime_error("afterwards"); };
  EXPECT_THROW(parallel_for(
                   100, 1, 2, [](std::size_t) {}, fail),
               std::runtime_error);
  const auto fail_first = [](std::size_t i) {
    if (i == 7) throw std::logic_error("item 7");
  };
  EXPECT_THROW(parallel_for(100, 1, 2, fail_first, fail), std::logic_error);
}

// The number given to an item is that of its thread: no two items run at the same time with the same number.
TEST(ParallelFor, GivesEachThreadANumberOfItsOwn) {
  constexpr int kThreads = 4;
  std::vector<std::atomic<bool>> busy(kThreads);
  std::atomic<int> failures = 0;
  parallel_for(2000, 3, kThreads, [&](std::size_t, int thread) {
    if (thread < 0 || thread >= kThreads || busy[thread].exchange(true)) {
      ++failures;
      return;
    }
    std::this_thread::yield();
    busy[thread] = false;
  });
  EXPECT_EQ(failures, 0);
}

// The first item waits until the second half has begun, which it has at once.
TEST(ParallelFor, EachThreadBeginsWithAPartOfItsOwn) {
  std::atomic<int> begun = 0, begun_before_the_second_half = -1;
  parallel_for(100, 1, 2, [&](std::size_t i) {
    if (i == 50) begun_before_the_second_half = begun.load();
    ++begun;
    if (i == 0) {
      EXPECT_TRUE(comes_true([&] { return begun_before_the_second_half >= 0; }));
    }
  });
  EXPECT_GE(begun_before_the_second_half, 0);
  EXPECT_LE(begun_before_the_second_half, 1);
}

// The first item waits until all others are done: somebody else does those that its thread would have gone on with.
TEST(ParallelFor, AThreadThatIsDoneHelpsTheOthers) {
  std::atomic<int> done = 0;
  parallel_for(100, 1, 2, [&](std::size_t i) {
    if (i == 0) {
      EXPECT_TRUE(comes_true([&] { return done == 99; }));
    }
    ++done;
  });
  EXPECT_EQ(done, 100);
}

TEST(ParallelFor, RunsInTheCallersThreadWhereThereIsLittleToDo) {
  const auto caller = std::this_thread::get_id();
  std::set<std::thread::id> seen;
  parallel_for(100, 1, 1, [&](std::size_t, int thread) {
    EXPECT_EQ(thread, 0);
    seen.insert(std::this_thread::get_id());
  });
  parallel_for(8, 8, 4, [&](std::size_t) { seen.insert(std::this_thread::get_id()); });
  EXPECT_EQ(seen, std::set{caller});
}

// Whichever item fails first in time, the exception that arrives is the one of the lowest index.
TEST(ParallelFor, ThrowsTheExceptionOfTheLowestIndex) {
  for (const int threads : {1, 2, 8}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      try {
        parallel_for(300, 1, threads, [](std::size_t i) {
          if (i == 37) std::this_thread::yield();
          if (i == 37 || i == 38 || i >= 200) throw std::runtime_error(std::to_string(i));
        });
        FAIL() << "no exception, threads " << threads;
      } catch (const std::runtime_error& error) {
        ASSERT_STREQ(error.what(), "37") << "threads " << threads;
      }
    }
  }
}

TEST(ParallelFor, StopsOnlyTheBlockThatFailed) {
  constexpr std::size_t kCount = 64, kGrain = 8, kFailing = 19;  // in the block of 16 to 23
  std::vector<std::atomic<int>> visits(kCount);
  const auto work = [&](std::size_t i) {
    ++visits[i];
    if (i == kFailing) throw std::runtime_error("stop");
  };
  EXPECT_THROW(parallel_for(kCount, kGrain, 2, work), std::runtime_error);
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(visits[i], i < 20 || i >= 24 ? 1 : 0) << "item " << i;
}

// Read from memory, so that the sum is made when the program runs. Rounded upward it is more than 1.
const volatile double kTerm = 1.0, kTinyTerm = 0x1p-60;

// What a thread works with may be half-way then.
TEST(ParallelFor, AThreadThatRanOutOfMemoryBeginsNoOtherItem) {
  constexpr std::size_t kCount = 1000;
  for (const int threads : {1, 2, 4}) {
    std::array<std::atomic<bool>, 4> ran_out = {};
    std::atomic<int> begun_after = 0;
    const auto work = [&](std::size_t i, int thread) {
      if (ran_out[static_cast<std::size_t>(thread)]) ++begun_after;
      if (i % 100 != 3) return;
      ran_out[static_cast<std::size_t>(thread)] = true;
      if (i % 200 == 3) throw std::bad_alloc();
      throw tact::Error(tact::ErrorCode::out_of_memory, "");
    };
    const auto help = [&](int thread) { begun_after += ran_out[static_cast<std::size_t>(thread)]; };
    EXPECT_ANY_THROW(parallel_for(kCount, 1, threads, work, help)) << threads;
    EXPECT_EQ(begun_after, 0) << threads;
  }
}

TEST(ParallelFor, RoundsToNearestAndLeavesTheCallersModeAsItWas) {
  for (const int threads : {1, 4}) {
    ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
    std::atomic<int> rounded_up = 0;
    parallel_for(100, 1, threads, [&](std::size_t) { rounded_up += kTerm + kTinyTerm > 1.0 ? 1 : 0; });
    const bool caller_rounds_up = kTerm + kTinyTerm > 1.0;
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(rounded_up, 0) << "threads " << threads;
    EXPECT_TRUE(caller_rounds_up) << "threads " << threads;
  }
}

}  // namespace

// The one place with OpenMP in it, or with the threads of a program that brings its own (workers.h), or with a pool of
// threads where OpenMP was left out. An item writes only to a slot of its own, so nothing depends on the number of
// threads; an exception is caught in its item and the one of the lowest index is thrown again after the loop. Where
// memory ran out no other item is begun: a thread's scratch may be half-way.
#pragma once

#if !defined(TACT_WITHOUT_OPENMP)
#include <omp.h>
#else
#include <thread>
#endif

#include <tact/error.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <new>
#include <type_traits>

#include "engine/base/floating_point_mode.h"
#if defined(TACT_WITHOUT_OPENMP)
#include "engine/base/thread_pool.h"
#endif
#include "engine/base/workers.h"

namespace tact::base {

// The most that Settings::threads takes.
inline constexpr int kMostThreads = 1024;

// The number of threads that `threads = 0` stands for.
inline int default_threads() {
#if !defined(TACT_WITHOUT_OPENMP)
  return std::clamp(omp_get_max_threads(), 1, kMostThreads);
#else
  return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, unsigned{kMostThreads}));
#endif
}

// How many neighbouring items to give out at a time: few enough that threads end together, and up to `most` of them,
// so that what an item asks memory for is wanted by the same thread.
inline std::size_t grain_of(std::size_t count, int threads, std::size_t least, std::size_t most) {
  constexpr std::size_t kBlocksPerThread = 32;
  return std::clamp(count / (kBlocksPerThread * static_cast<std::size_t>(threads)), least, most);
}

template <class Work>
void call_work(const Work& work, std::size_t item, int thread) {
  if constexpr (std::is_invocable_v<const Work&, std::size_t, int>) {
    work(item, thread);
  } else {
    work(item);
  }
}

// The blocks that one thread begins with, and takes one by one; the others help when they are done with theirs.
struct alignas(64) BlockShare {
  std::atomic<std::size_t> next;
  std::size_t end;
};

// The exception of the item with the lowest index among those that failed. All items are tried where input is refused,
// so that it is the same one for any number of threads.
class FirstException {
 public:
  void keep(std::size_t index) {
    if (is_want_of_memory()) ends_loop_ = true;
    const std::lock_guard lock(mutex_);
    if (exception_ && index_ <= index) return;
    index_ = index;
    exception_ = std::current_exception();
  }
  // Whether memory ran out.
  bool ends_loop() const { return ends_loop_.load(std::memory_order_relaxed); }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  // Of the exception that is being handled.
  static bool is_want_of_memory() {
    try {
      throw;
    } catch (const std::bad_alloc&) {
      return true;
    } catch (const Error& error) {
      return error.code() == ErrorCode::out_of_memory || error.code() == ErrorCode::backend_failure;
    } catch (...) {
      return false;
    }
  }

  std::atomic<bool> ends_loop_ = false;
  std::mutex mutex_;
  std::size_t index_ = 0;
  std::exception_ptr exception_;
};

// What parallel_for() does by default for a thread that is left without items.
struct Nothing {
  void operator()(int) const {}
};

// A loop that several threads do.
template <class Work, class Afterwards>
class SharedLoop {
 public:
  SharedLoop(std::size_t count, std::size_t grain, int threads, const Work& work, const Afterwards& afterwards)
      : count_(count), grain_(grain), blocks_((count + grain - 1) / grain), work_(work), afterwards_(afterwards) {
    share_count_ = std::min({static_cast<std::size_t>(threads), blocks_, kMostShares});
    for (std::size_t k = 0; k < share_count_; ++k) {
      shares_[k].next.store(blocks_ * k / share_count_, std::memory_order_relaxed);
      shares_[k].end = blocks_ * (k + 1) / share_count_;
    }
  }

  // What one of the threads does: its own share, then what others have left.
  void run(int thread) {
    const FloatingPointMode mode;
    for (std::size_t k = 0; k < share_count_; ++k) {
      BlockShare& share = shares_[(static_cast<std::size_t>(thread) + k) % share_count_];
      const auto take = [&] { return share.next.fetch_add(1, std::memory_order_relaxed); };
      for (std::size_t block = take(); block < share.end && !failed_.ends_loop(); block = take())
        run_block(block, thread);
    }
    if (failed_.ends_loop()) return;
    try {
      afterwards_(thread);
    } catch (...) {
      failed_.keep(count_);
    }
  }
  std::size_t blocks() const { return blocks_; }
  const FirstException& failed() const { return failed_; }

 private:
  static constexpr std::size_t kMostShares = 16;

  void run_block(std::size_t block, int thread) {
    for (std::size_t i = block * grain_, end = std::min(i + grain_, count_); i < end; ++i) {
      try {
        call_work(work_, i, thread);
      } catch (...) {
        failed_.keep(i);
        return;
      }
    }
  }

  BlockShare shares_[kMostShares];
  std::size_t share_count_, count_, grain_, blocks_;
  const Work& work_;
  const Afterwards& afterwards_;
  FirstException failed_;
};

#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kThreadSanitizer = __has_feature(thread_sanitizer);
#else
inline constexpr bool kThreadSanitizer = false;
#endif

// Keeps the largest of the values given.
template <class Value>
void raise_to(std::atomic<Value>& most, Value value) {
  for (Value known = most; known < value && !most.compare_exchange_weak(known, value);) {
  }
}

// Keeps the smallest of the values given.
template <class Value>
void lower_to(std::atomic<Value>& least, Value value) {
  for (Value known = least; value < known && !least.compare_exchange_weak(known, value);) {
  }
}

#if !defined(TACT_WITHOUT_OPENMP)
// Calls run(thread) on `threads` threads of OpenMP. What it loses by threads that are not allowed to run is noted: the
// wait before the caller's own work (for threads that have not left the last loop) and after the last work of all, and
// of that between, as much as some thread did not run.
template <class Run>
void run_on_openmp(int threads, int wanted, Workers* workers, const Run& run) {
  const auto begin = Workers::Clock::now();
  const auto since_begin = [&] {
    return std::chrono::duration<double, std::milli>(Workers::Clock::now() - begin).count();
  };
  double own_begin_ms = 0.0, own_end_ms = 0.0;
  std::atomic<double> delay_ms = 0.0, last_end_ms = 0.0;
#pragma omp parallel num_threads(threads)
  {
    if (const int thread = omp_get_thread_num(); thread == 0 || workers == nullptr) {
      if (thread == 0) own_begin_ms = since_begin();
      run(thread);
      if (thread == 0) own_end_ms = since_begin();
    } else {
      const WorkerClock clock;
      run(thread);
      raise_to(delay_ms, clock.delay_ms(begin));
      raise_to(last_end_ms, since_begin());
    }
    if (kThreadSanitizer) {
      // By this, as at the end of a work-sharing loop, it sees that nothing here is read any more.
#pragma omp barrier
    }
  }
  if (workers == nullptr) return;
  const double end_ms = since_begin(), after_own_ms = std::max(last_end_ms - own_end_ms, 0.0);
  const double ended_ms = own_end_ms + after_own_ms;  // the last work
  workers->note(threads, wanted, end_ms, own_begin_ms + end_ms - ended_ms + std::min(after_own_ms, delay_ms.load()));
}
#endif

// Calls run(thread) for each of `threads` on the threads of a program. What it leaves out is done here.
template <class Run>
void run_on_executor(int threads, Executor& executor, const Run& run) {
  struct Call {
    const Run& run;
    int threads;
    std::array<std::atomic<std::uint64_t>, kMostThreads / 64> called = {};  // a bit a task

    void once(int index) {
      if (index < 0 || index >= threads) return;
      const std::uint64_t bit = std::uint64_t{1} << index % 64;
      if ((called[static_cast<std::size_t>(index) / 64].fetch_or(bit) & bit) == 0) run(index);
    }
  } call{run, threads};
  executor.run(threads, Executor::Task([](void* data, int index) { static_cast<Call*>(data)->once(index); }, &call));
  for (int index = 0; index < threads; ++index) call.once(index);
}

// Calls work(i), or work(i, thread) with 0 <= thread < threads, for every 0 <= i < count, `grain` neighbouring items at
// a time, on up to `threads` threads. With one thread, or no more than `grain` items, it runs in the calling thread. Of
// loops over the same items a thread takes the same part, as far as it can, and finds them in its cache. One of several
// threads that is left without items, while others may still have some, calls afterwards(thread).
template <class Work, class Afterwards = Nothing>
void parallel_for(std::size_t count, std::size_t grain, int threads, const Work& work,
                  const Afterwards& afterwards = {}) {
  if (threads <= 1 || count <= grain) {
    const FloatingPointMode mode;
    for (std::size_t i = 0; i < count; ++i) call_work(work, i, 0);
    return;
  }
  Workers* const workers = Workers::current();
  const int allowed = workers != nullptr ? workers->allowed(threads) : threads;
  SharedLoop<Work, Afterwards> loop(count, grain, allowed, work, afterwards);
  const auto run = [&](int thread) { loop.run(thread); };
  Executor* executor = workers != nullptr ? workers->executor() : nullptr;
#if defined(TACT_WITHOUT_OPENMP)
  if (executor == nullptr) executor = &ThreadPool::shared();
#endif
  if (executor != nullptr) {
    const auto tasks = std::min({loop.blocks(), static_cast<std::size_t>(threads), std::size_t{kMostThreads}});
    run_on_executor(static_cast<int>(tasks), *executor, run);
    loop.failed().rethrow();
    return;
  }
#if !defined(TACT_WITHOUT_OPENMP)
  if (allowed <= 1) {
    const auto begin = Workers::Clock::now();
    run(0);
    workers->note(1, threads, std::chrono::duration<double, std::milli>(Workers::Clock::now() - begin).count(), 0.0);
  } else {
    run_on_openmp(allowed, threads, workers, run);
  }
  loop.failed().rethrow();
#endif
}

}  // namespace tact::base

// Who does the work of a world's loops: OpenMP's threads, or a program's own; and how many of them, while other
// programs keep the processor busy.
#pragma once

#include <tact/executor.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

namespace tact::base {

// At the end of an OpenMP loop the caller waits for every thread, also for one that the system has not let run: 1 to 20
// milliseconds beside a busy program (tact-bench busy). Nothing in OpenMP lets it go on. So what is lost that way is
// measured, and the next loops use fewer threads: until they have worked for some multiple of what was lost, and twice
// as long each time that happens again.
//
// Loops that several threads begin at once may be the work of the same Workers.
class Workers {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Workers(std::shared_ptr<Executor> executor = {}) : executor_(std::move(executor)) {}

  // Those of the world whose function the calling thread is in; null elsewhere.
  static Workers* current() { return current_; }

  Executor* executor() const { return executor_.get(); }
  // Starts from nothing, with another executor or with OpenMP's threads. No loop runs meanwhile.
  void restart(std::shared_ptr<Executor> executor);
  // As many threads of `wanted` as a loop should use now.
  int allowed(int wanted) const { return std::min(wanted, limit_.load(std::memory_order_relaxed)); }
  bool limited() const { return limit_.load(std::memory_order_relaxed) != kNoLimit; }
  // A loop took `loop_ms` on `threads` of `wanted` threads; of it the caller was idle for `lost_ms`, because another
  // thread did not run.
  void note(int threads, int wanted, double loop_ms, double lost_ms);

  // While it lives, loops of the calling thread are the work of `workers`.
  class Scope {
   public:
    explicit Scope(Workers& workers) : outer_(current_) { current_ = &workers; }
    ~Scope() { current_ = outer_; }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Workers* outer_;
  };

 private:
  static constexpr int kNoLimit = 1 << 30;
  static thread_local constinit Workers* current_;

  std::shared_ptr<Executor> executor_;
  std::atomic<int> limit_{kNoLimit};
  std::mutex noting_;  // of the limit and of what follows
  int doublings_ = 0;
  double pause_ms_ = 0.0;  // the last pause: to work with fewer threads
  double left_ms_ = 0.0;   // of it
  double good_ms_ = 0.0;   // worked since, with nothing lost
};

// The clock of a thread that works for another: how much of the time it was not allowed to run.
class WorkerClock {
 public:
  WorkerClock();
  // Milliseconds from `loop_begin` to the construction, and those since then in which the thread did not run.
  double delay_ms(Workers::Clock::time_point loop_begin) const;

 private:
  static std::int64_t processor_ns();
  Workers::Clock::time_point begin_;
  std::int64_t processor_begin_;
};

}  // namespace tact::base

#include "engine/base/workers.h"

#include <time.h>  // NOLINT: clock_gettime() is that of POSIX

#include <algorithm>

namespace tact {

Executor::~Executor() = default;

namespace base {

namespace {

// What tact-bench busy settled on. A thread that sleeps takes 0.05 ms to begin; one that has no core, a slice of 1
// to 20.
constexpr double kLost_ms = 0.2;     // less is no sign
constexpr double kLostPart = 0.25;   // of the loop
constexpr double kFirstPause = 8.0;  // times what was lost
constexpr int kMostDoublings = 16;
constexpr double kLongestPause_ms = 5000.0;  // what is lost in trying is no part of one in a hundred steps

}  // namespace

thread_local constinit Workers* Workers::current_ = nullptr;

void Workers::restart(std::shared_ptr<Executor> executor) {
  executor_ = std::move(executor);
  limit_ = kNoLimit;
  doublings_ = 0;
  pause_ms_ = left_ms_ = good_ms_ = 0.0;
}

void Workers::note(int threads, int wanted, double loop_ms, double lost_ms) {
  const std::lock_guard lock(noting_);
  if (threads > 1 && lost_ms > kLost_ms && lost_ms > kLostPart * loop_ms) {
    pause_ms_ = std::min(kFirstPause * static_cast<double>(1 << doublings_) * lost_ms, kLongestPause_ms);
    left_ms_ = pause_ms_;
    good_ms_ = 0.0;
    doublings_ = std::min(doublings_ + 1, kMostDoublings);
    limit_ = threads / 2;
  } else if (limited()) {
    left_ms_ -= loop_ms;
    if (left_ms_ > 0.0) return;
    const int doubled = 2 * limit_;
    limit_ = doubled < wanted ? doubled : kNoLimit;
    left_ms_ = pause_ms_;
  } else if (doublings_ > 0) {
    good_ms_ += loop_ms;
    if (good_ms_ > pause_ms_) doublings_ = 0;
  }
}

std::int64_t WorkerClock::processor_ns() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

WorkerClock::WorkerClock() : begin_(Workers::Clock::now()), processor_begin_(processor_ns()) {}

double WorkerClock::delay_ms(Workers::Clock::time_point loop_begin) const {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const double ran_ms = 1e-6 * static_cast<double>(processor_ns() - processor_begin_);
  return std::max(Milliseconds(Workers::Clock::now() - loop_begin).count() - ran_ms, 0.0);
}

}  // namespace base
}  // namespace tact

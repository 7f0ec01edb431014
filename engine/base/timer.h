// Wall time in milliseconds.
#pragma once

#include <chrono>

namespace tact::base {

class Timer {
 public:
  using Clock = std::chrono::steady_clock;

  // Milliseconds since construction or the last call of lap().
  double lap() {
    const auto now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }
  // The time of construction or of the last call of lap().
  Clock::time_point start() const { return start_; }

 private:
  Clock::time_point start_ = Clock::now();
};

}  // namespace tact::base

#include "engine/base/timer.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace tact::base {

// Whether the processor promises an invariant time stamp counter (Intel, Software Developer's Manual, 3B,
// chapter 18.17).
bool TickCounter::exists() {
#if defined(__x86_64__)
  static const bool promised = [] {
    constexpr unsigned kPowerManagement = 0x80000007u, kInvariant = 1u << 8;
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid(kPowerManagement, &a, &b, &c, &d) != 0 && (d & kInvariant) != 0;
  }();
  return promised;
#else
  return false;
#endif
}

double TickCounter::tick_ms() {
  struct Reading {
    Timer::Clock::time_point time;
    std::int64_t ticks;
  };
  constexpr double kEarly = 0.1;  // milliseconds
  if (!exists()) return 0.0;
  const Reading reading{Timer::Clock::now(), now()};
  static const Reading first = reading;
  const double ms = std::chrono::duration<double, std::milli>(reading.time - first.time).count();
  return ms > kEarly && reading.ticks > first.ticks ? ms / static_cast<double>(reading.ticks - first.ticks) : 0.0;
}

}  // namespace tact::base

// The floating-point mode of a caller, for as long as it lives.
#pragma once

#include <cfenv>
#include <cstdint>
#include <vector>

#include "tests/support/environment/floating_point_state.h"

namespace tact::tests {

struct FloatingPointSettings {
  const char* name = "nearest";
  int rounding = FE_TONEAREST;
  unsigned x87_precision = 3;  // 3, 2, 0: 64, 53, 24 digits
  bool flushes = false;        // subnormal results and operands are zero
  bool traps = false;          // every exception ends in SIGFPE, inexact results too
};

inline std::vector<FloatingPointSettings> callers_modes() {
  return {{.name = "nearest"},
          {.name = "upward", .rounding = FE_UPWARD},
          {.name = "downward", .rounding = FE_DOWNWARD},
          {.name = "to zero", .rounding = FE_TOWARDZERO},
          {.name = "x87 of 53 digits", .rounding = FE_UPWARD, .x87_precision = 2},
          {.name = "x87 of 24 digits", .x87_precision = 0},
          {.name = "flush to zero", .flushes = true},
          {.name = "traps", .traps = true},
          {.name = "all of it", .rounding = FE_DOWNWARD, .x87_precision = 0, .flushes = true, .traps = true}};
}

class CallersMode {
 public:
  explicit CallersMode(const FloatingPointSettings& settings) {
    std::fesetround(settings.rounding);
#if defined(__x86_64__) && defined(__GNUC__)
    std::uint16_t control = 0;
    __asm__ volatile("fnstcw %0" : "=m"(control));
    control = static_cast<std::uint16_t>((control & ~0x300u) | settings.x87_precision << 8);
    __asm__ volatile("fldcw %0" : : "m"(control));
#endif
    if (settings.flushes) flush_subnormals();
#if defined(__GLIBC__)
    std::feclearexcept(FE_ALL_EXCEPT);
    if (settings.traps) feenableexcept(FE_ALL_EXCEPT);
#endif
  }

 private:
  SavedFloatingPointState saved_;
};

/// What call() returns in a caller's mode.
template <class Call>
decltype(auto) in_mode(const FloatingPointSettings& settings, const Call& call) {
  const CallersMode mode(settings);
  return call();
}

}  // namespace tact::tests

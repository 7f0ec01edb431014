// The floating-point mode in which every answer is computed: round to nearest, subnormal numbers kept, no traps. A
// caller, or a library that shares its threads, may have set another (Embree advises flush-to-zero); every thread that
// computes holds one of these and leaves the caller's mode as it was.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace tact::base {

#if defined(__SSE2__)
class FloatingPointMode {
 public:
  FloatingPointMode() : saved_(_mm_getcsr()) {
    _mm_setcsr(kDefault);
#if defined(__MINGW32__)  // functions of its <cmath> compute with the x87
    __asm__ volatile("fnstcw %0" : "=m"(saved_x87_));
    __asm__ volatile("fldcw %0" : : "m"(kDefaultX87));
#endif
  }
  ~FloatingPointMode() {
    _mm_setcsr(saved_);
#if defined(__MINGW32__)
    __asm__ volatile("fldcw %0" : : "m"(saved_x87_));
#endif
  }
  FloatingPointMode(const FloatingPointMode&) = delete;
  FloatingPointMode& operator=(const FloatingPointMode&) = delete;

 private:
  static constexpr unsigned kDefault = 0x1f80;  // all exceptions masked, round to nearest, no FTZ, no DAZ
  unsigned saved_;
#if defined(__MINGW32__)
  static constexpr unsigned short kDefaultX87 = 0x037f;  // the same, with all bits of the mantissa
  unsigned short saved_x87_ = kDefaultX87;
#endif
};
#else
class FloatingPointMode {
 public:
  FloatingPointMode() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatingPointMode() { std::fesetenv(&saved_); }
  FloatingPointMode(const FloatingPointMode&) = delete;
  FloatingPointMode& operator=(const FloatingPointMode&) = delete;

 private:
  std::fenv_t saved_;
};
#endif

}  // namespace tact::base

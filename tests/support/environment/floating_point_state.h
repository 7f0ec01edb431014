// The floating-point mode of the calling thread, as tests change it.
#pragma once

#include <cfenv>
#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace tact::tests {

// Gives the mode back when its life ends. std::fesetenv() of MinGW leaves the register of SSE as it is.
class SavedFloatingPointState {
 public:
  SavedFloatingPointState() { std::fegetenv(&saved_); }
  ~SavedFloatingPointState() {
    std::fesetenv(&saved_);
#if defined(__SSE2__)
    _mm_setcsr(of_sse_);
#endif
  }
  SavedFloatingPointState(const SavedFloatingPointState&) = delete;
  SavedFloatingPointState& operator=(const SavedFloatingPointState&) = delete;

 private:
#if defined(__SSE2__)
  unsigned of_sse_ = _mm_getcsr();
#endif
  std::fenv_t saved_;
};

// Results and operands below the least normal number become zero, as Embree advises its users. Processors that cannot
// do so are left as they are.
#if defined(__SSE2__)
constexpr bool kCanFlushSubnormals = true;
constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
inline void flush_subnormals() { _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero); }
inline bool flushes_subnormals() { return (~_mm_getcsr() & (kFlushToZero | kDenormalsAreZero)) == 0; }
#elif defined(__aarch64__)
constexpr bool kCanFlushSubnormals = true;
constexpr std::uint64_t kFlushToZero = 1 << 24;  // operands too
inline std::uint64_t control_register() {
  std::uint64_t control = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  return control;
}
inline void flush_subnormals() { __asm__ volatile("msr fpcr, %0" : : "r"(control_register() | kFlushToZero)); }
inline bool flushes_subnormals() { return (control_register() & kFlushToZero) != 0; }
#else
constexpr bool kCanFlushSubnormals = false;
inline void flush_subnormals() {}
inline bool flushes_subnormals() { return false; }
#endif

}  // namespace tact::tests

// Results and operands below the least normal number become zero in the calling thread, as Embree advises its users:
// until std::fesetenv() restores the mode. Processors that cannot do so are left as they are.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace tact::tests {

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

// a b + c, rounded once. The C library's own is right where the processor or the library makes it so; that of MinGW is
// not: it adds in the format of the x87, which rounds a second time.
#pragma once

#if defined(__MINGW32__) && !defined(__FMA__)
#define TACT_FUSED_BY_INTEGERS
#endif

#include <cstdint>
#include <cstring>

namespace tact::base {

// A float times a float is exact in double. What the sum loses is kept in its last bit ("rounding to odd"), so that
// the float is rounded as the exact sum would be (Boldo and Melquiond, "Emulation of a FMA and correctly rounded sums:
// proved algorithms using rounding to odd", 2008).
static inline float fused_by_doubles(float a, float b, float c) {
  const double product = static_cast<double>(a) * b, added = c, sum = product + added;
  const double of_added = sum - product, lost = (product - (sum - of_added)) + (added - of_added);
  if (!(lost != 0.0) || lost - lost != 0.0) return static_cast<float>(sum);
  std::int64_t bits;
  std::memcpy(&bits, &sum, sizeof bits);
  if ((bits & 1) == 0) bits += (lost > 0.0) == (sum > 0.0) ? 1 : -1;
  double odd;
  std::memcpy(&odd, &bits, sizeof odd);
  return static_cast<float>(odd);
}

// A number of up to 126 bits times a power of two, whose highest bit is the 125th.
struct HighInteger {
  __extension__ typedef unsigned __int128 Bits;
  Bits bits;
  int exponent;
  bool negative;

  void shift_up() {
    while ((bits >> 125) == 0) {
      bits <<= 1;
      --exponent;
    }
  }
  // The lowest bit is set if any is lost.
  void shift_down(int by) {
    if (by <= 0) return;
    const Bits lost = by > 127 ? bits : bits & ((Bits{1} << by) - 1);
    bits = (by > 127 ? Bits{0} : bits >> by) | (lost != 0 ? 1u : 0u);
    exponent += by;
  }
};

// The mantissa of a finite number other than zero.
static inline HighInteger mantissa_of(double a) {
  std::uint64_t bits;
  std::memcpy(&bits, &a, sizeof bits);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  const std::uint64_t fraction = bits & 0xfffffffffffff;
  return {biased == 0 ? fraction : fraction | std::uint64_t{1} << 52, (biased == 0 ? 1 : biased) - 1075,
          (bits >> 63) != 0};
}

static inline double power_of_two(int exponent) {
  const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
  double power;
  std::memcpy(&power, &bits, sizeof power);
  return power;
}

static inline double fused_by_integers(double a, double b, double c) {
  constexpr int kLowest = -1076, kKept = 55;  // bits: two below those of a double, the lower for all that is lost
  if (a == 0.0 || b == 0.0 || !(a - a == 0.0 && b - b == 0.0 && c - c == 0.0)) return a * b + c;
  HighInteger sum = mantissa_of(a);
  const HighInteger of_b = mantissa_of(b);
  sum = {sum.bits * of_b.bits, sum.exponent + of_b.exponent, sum.negative != of_b.negative};
  sum.shift_up();
  if (c != 0.0) {
    HighInteger added = mantissa_of(c);
    added.shift_up();
    HighInteger &large = sum.exponent > added.exponent ? sum : added, &small = &large == &sum ? added : sum;
    small.shift_down(large.exponent - small.exponent);
    if (sum.negative == added.negative) {
      sum.bits += added.bits;
    } else {
      const bool turns = sum.bits < added.bits;
      sum = {turns ? added.bits - sum.bits : sum.bits - added.bits, sum.exponent, sum.negative != turns};
    }
    if (sum.bits == 0) return 0.0;
  }
  int length = 128;
  while ((sum.bits >> (length - 1)) == 0) --length;
  const int too_low = kLowest - sum.exponent;
  sum.shift_down(length - kKept > too_low ? length - kKept : too_low);
  const double rounded = static_cast<double>(static_cast<std::uint64_t>(sum.bits));
  // Two powers, of which the second product alone may be rounded, or grow too large.
  const int first = sum.exponent / 2;
  const double size = rounded * power_of_two(first) * power_of_two(sum.exponent - first);
  return sum.negative ? -size : size;
}

static inline double fused(double a, double b, double c) {
#if defined(TACT_FUSED_BY_INTEGERS)
  return fused_by_integers(a, b, c);
#else
  return __builtin_fma(a, b, c);
#endif
}
static inline float fused(float a, float b, float c) {
#if defined(TACT_FUSED_BY_INTEGERS)
  return fused_by_doubles(a, b, c);
#else
  return __builtin_fmaf(a, b, c);
#endif
}

}  // namespace tact::base

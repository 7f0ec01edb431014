// Finite doubles as integers times a power of two.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "narrowphase/numeric/wide_integer.h"

namespace tact::narrowphase {

// A finite double is (negative ? -1 : 1) * mantissa * 2^(exponent - 1075).
struct DoubleParts {
  explicit DoubleParts(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto field = static_cast<int>((bits >> 52) & 0x7ff);
    negative = (bits >> 63) != 0;
    exponent = std::max(field, 1);
    mantissa = (bits & ((std::uint64_t{1} << 52) - 1)) | (static_cast<std::uint64_t>(field != 0) << 52);
  }
  bool negative;
  int exponent;
  std::uint64_t mantissa;
};

// The exponent of the lowest bit that is set: in units of 2^(k - 1075) for any k up to it, x is an integer. The largest
// int for zero.
inline int lowest_bit(double x) {
  const DoubleParts parts(x);
  return parts.mantissa == 0 ? std::numeric_limits<int>::max() : parts.exponent + std::countr_zero(parts.mantissa);
}

// x in units of 2^(unit - 1075); `unit` is at most lowest_bit(x), and the result fits.
template <int kCapacity>
WideInteger<kCapacity> in_units(double x, int unit) {
  const DoubleParts parts(x);
  if (parts.mantissa == 0) return {};
  const int zeros = std::countr_zero(parts.mantissa);
  return {parts.negative, parts.mantissa >> zeros, parts.exponent + zeros - unit};
}

}  // namespace tact::narrowphase

// A unit of length in which what is computed neither vanishes nor overflows.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tact::narrowphase {

// The power of two, between 2^-1000 and 2^1000, that scales a length of `largest` to between 1 and 2, or as near as it
// can; 1 for a length of zero. Multiplying by it rounds nothing.
inline double unit_scale(double largest) {
  constexpr int kDigits = std::numeric_limits<double>::digits - 1,
                kBias = std::numeric_limits<double>::max_exponent - 1;
  const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> kDigits);  // biased
  if (exponent > kBias - 1000 && exponent < kBias + 1000)                                    // the same, sooner
    return std::bit_cast<double>(static_cast<std::uint64_t>(2 * kBias - exponent) << kDigits);
  return largest > 0.0 ? std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000)) : 1.0;
}

}  // namespace tact::narrowphase

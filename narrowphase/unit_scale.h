// A unit of length in which what is computed neither vanishes nor overflows.
#pragma once

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {

// The power of two by which a length of `largest` becomes one from 1 to 2, or as near to it as 2^1000 brings it; 1 for
// no length. Multiplying by it rounds nothing.
inline double unit_scale(double largest) {
  return largest > 0.0 ? std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000)) : 1.0;
}

}  // namespace tact::narrowphase

// What all loops over packs have in common. A tail of fewer than kWidth elements is read from a padded array where the
// caller promises padding (points and boxes: see kPadding), and its lanes are masked off.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/packs.h"

namespace tact::narrowphase {
namespace {

static_assert(__FLT_EVAL_METHOD__ == 0, "an operation in double has to be rounded to double");

// Packs and masks of doubles or floats.
template <class Real>
struct Lanes {
  using Packed = Pack;
  using Masked = Mask;
  static constexpr int kCount = kWidth;
};
template <>
struct Lanes<float> {
  using Packed = FloatPack;
  using Masked = FloatMask;
  static constexpr int kCount = kFloatWidth;
};
template <class Real>
using PackOf = typename Lanes<Real>::Packed;
template <class Real>
using MaskOf = typename Lanes<Real>::Masked;

constexpr unsigned kAllLanes = (1u << kWidth) - 1u;
constexpr unsigned kAllFloatLanes = (1u << kFloatWidth) - 1u;

template <int kLanes = kWidth>
inline unsigned lanes_left(int left) {
  return left >= kLanes ? (1u << kLanes) - 1u : (1u << left) - 1u;
}

inline int append(unsigned mask, int first, std::int32_t* indices, int found) {
  while (mask != 0) {
    indices[found++] = first + __builtin_ctz(mask);
    mask &= mask - 1;
  }
  return found;
}

template <class AnyMask>
inline AnyMask without(AnyMask a, AnyMask b) {
  return differ(a, both(a, b));
}

}  // namespace
}  // namespace tact::narrowphase

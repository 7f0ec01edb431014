// Vectors of the width for which a file is compiled, in the vector types of GCC and Clang; those of sixteen bytes are
// the ones of engine/base/simd128.h. (Wider ones the compilers take apart into single numbers, as they do plain loops
// of sixteen.) Everything is static: each file has its own copy.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "engine/base/simd128.h"

namespace tact::broadphase {

#if defined(__AVX512F__)
inline constexpr std::uint32_t kFloats = 16;
#elif defined(__AVX2__)
inline constexpr std::uint32_t kFloats = 8;
#else
inline constexpr std::uint32_t kFloats = 4;
#endif
inline constexpr std::uint32_t kDoubles = kFloats / 2;

using Floats = float __attribute__((vector_size(kFloats * sizeof(float))));
using Doubles = double __attribute__((vector_size(kDoubles * sizeof(double))));
using FloatMask = decltype(Floats{} < Floats{});  // which integers these are differs between compilers
using DoubleMask = decltype(Doubles{} < Doubles{});
using HalfFloats = float __attribute__((vector_size(kDoubles * sizeof(float))));

// A bit for each element; elements are 0 or -1, as comparisons make them.
static inline std::uint32_t bits_of(FloatMask mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
  return base::bits_of(mask);
#endif
}

static inline std::uint32_t bits_of(DoubleMask mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#else
  return base::bits_of(mask);
#endif
}

// -1 in each element whose bit is set.
static inline FloatMask mask_of(std::uint32_t bits) {
  FloatMask own;
  for (std::uint32_t i = 0; i < kFloats; ++i) own[i] = 1 << i;
  return (own & static_cast<std::int32_t>(bits)) != 0;
}

}  // namespace tact::broadphase

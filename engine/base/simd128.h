// Vectors of sixteen bytes, in the vector types of GCC and Clang, which every machine with registers of that size adds,
// compares and converts by itself. What these types have no operator for stands here: by name where the machine has an
// instruction (NEON, SSE2, SIMD128 of WebAssembly), element by element elsewhere. Comparisons give 0 or -1 an element.
// Everything is static, as each file of kernels is compiled for a machine of its own.
#pragma once

#include <cstdint>
#include <cstring>

#include "engine/base/fused.h"

#if defined(__ARM_NEON)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace tact::base {

using Doubles2 = double __attribute__((vector_size(16)));
using Floats4 = float __attribute__((vector_size(16)));
using Longs2 = decltype(Doubles2{} < Doubles2{});  // which integers these are differs between compilers
using Ints4 = decltype(Floats4{} < Floats4{});
using Shorts8 = std::int16_t __attribute__((vector_size(16)));
using Bytes16 = std::uint8_t __attribute__((vector_size(16)));
using Floats2 = float __attribute__((vector_size(8)));
using Shorts4 = std::int16_t __attribute__((vector_size(8)));

template <class Vector, class Number>
static inline Vector load_as(const Number* numbers) {
  Vector vector;
  std::memcpy(&vector, numbers, sizeof vector);
  return vector;
}

template <class Vector, class Number>
static inline void store_as(Number* numbers, Vector vector) {
  std::memcpy(numbers, &vector, sizeof vector);
}

// A bit for each element of a comparison.
static inline std::uint32_t bits_of(Longs2 mask) {
#if defined(__ARM_NEON)
  return static_cast<std::uint32_t>(vaddvq_s64(mask & Longs2{1, 2}));
#elif defined(__wasm_simd128__)
  return wasm_i64x2_bitmask(reinterpret_cast<v128_t>(mask));
#elif defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  return (mask[0] != 0 ? 1u : 0u) | (mask[1] != 0 ? 2u : 0u);
#endif
}

static inline std::uint32_t bits_of(Ints4 mask) {
#if defined(__ARM_NEON)
  return static_cast<std::uint32_t>(vaddvq_s32(mask & Ints4{1, 2, 4, 8}));
#elif defined(__wasm_simd128__)
  return wasm_i32x4_bitmask(reinterpret_cast<v128_t>(mask));
#elif defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) bits |= (mask[i] != 0 ? 1u : 0u) << i;
  return bits;
#endif
}

// A bit for each of 64 bytes, four vectors of a comparison.
static inline std::uint64_t bits_of(const Bytes16 (&mask)[4]) {
#if defined(__ARM_NEON)
  // Sums of neighbours, three times: then each byte holds the bits of eight.
  const Bytes16 bit{1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
  const uint8x16_t low = vpaddq_u8(mask[0] & bit, mask[1] & bit), high = vpaddq_u8(mask[2] & bit, mask[3] & bit);
  const uint8x16_t four = vpaddq_u8(low, high);
  return vgetq_lane_u64(vreinterpretq_u64_u8(vpaddq_u8(four, four)), 0);
#else
  std::uint64_t bits = 0;
  for (int k = 0; k < 4; ++k) {
#if defined(__wasm_simd128__)
    const std::uint32_t sixteen = wasm_i8x16_bitmask(reinterpret_cast<v128_t>(mask[k]));
#elif defined(__SSE2__)
    const auto sixteen = static_cast<std::uint32_t>(_mm_movemask_epi8(reinterpret_cast<__m128i>(mask[k])));
#else
    std::uint32_t sixteen = 0;
    for (int i = 0; i < 16; ++i) sixteen |= (mask[k][i] != 0 ? 1u : 0u) << i;
#endif
    bits |= static_cast<std::uint64_t>(sixteen) << 16 * k;
  }
  return bits;
#endif
}

// Bit by bit: `yes` where the mask has one, else `no`.
template <class Vector, class Mask>
static inline Vector choose(Mask mask, Vector yes, Vector no) {
#if defined(__ARM_NEON)
  return reinterpret_cast<Vector>(vbslq_u8(reinterpret_cast<uint8x16_t>(mask), reinterpret_cast<uint8x16_t>(yes),
                                           reinterpret_cast<uint8x16_t>(no)));
#elif defined(__wasm_simd128__)
  return reinterpret_cast<Vector>(
      wasm_v128_bitselect(reinterpret_cast<v128_t>(yes), reinterpret_cast<v128_t>(no), reinterpret_cast<v128_t>(mask)));
#else
  return reinterpret_cast<Vector>((mask & reinterpret_cast<Mask>(yes)) | (~mask & reinterpret_cast<Mask>(no)));
#endif
}

// a b + c, rounded once.
static inline Doubles2 fused(Doubles2 a, Doubles2 b, Doubles2 c) {
#if defined(__ARM_NEON)
  return vfmaq_f64(c, a, b);
#else
  return Doubles2{fused(a[0], b[0], c[0]), fused(a[1], b[1], c[1])};
#endif
}

static inline Floats4 fused(Floats4 a, Floats4 b, Floats4 c) {
#if defined(__ARM_NEON)
  return vfmaq_f32(c, a, b);
#else
  return Floats4{fused(a[0], b[0], c[0]), fused(a[1], b[1], c[1]), fused(a[2], b[2], c[2]), fused(a[3], b[3], c[3])};
#endif
}

// of[place], or 0 for places from 16 on.
static inline Bytes16 look_up(Bytes16 of, Bytes16 place) {
#if defined(__ARM_NEON)
  return vqtbl1q_u8(of, place);
#elif defined(__wasm_simd128__)
  return reinterpret_cast<Bytes16>(wasm_i8x16_swizzle(reinterpret_cast<v128_t>(of), reinterpret_cast<v128_t>(place)));
#else
  Bytes16 found;
  for (int i = 0; i < 16; ++i) found[i] = place[i] < 16 ? of[place[i]] : std::uint8_t{0};
  return found;
#endif
}

// table[place] for the places below `count`, 0 beyond; up to 63 bytes behind them are read, and count <= 192.
static inline Bytes16 look_up(const std::uint8_t* table, int count, Bytes16 place) {
  Bytes16 found{};
#if defined(__ARM_NEON)
  for (int first = 0; first < count; first += 64) {
    const uint8x16x4_t here = vld1q_u8_x4(table + first);
    found |= vqtbl4q_u8(here, place);
    place -= std::uint8_t{64};
  }
#else
  for (int first = 0; first < count; first += 16) {
    found |= look_up(load_as<Bytes16>(table + first), place);
    place -= std::uint8_t{16};
  }
#endif
  return found;
}

// Eight bytes, of a vector whose others have no meaning.
static inline Bytes16 load_eight(const void* bytes) {
  std::uint64_t eight;
  std::memcpy(&eight, bytes, sizeof eight);
  return reinterpret_cast<Bytes16>(Longs2{static_cast<std::int64_t>(eight), 0});
}
static inline void store_eight(std::uint8_t* bytes, Bytes16 vector) {
  const std::int64_t eight = reinterpret_cast<Longs2>(vector)[0];
  std::memcpy(bytes, &eight, sizeof eight);
}

// The low bytes of sixteen numbers.
static inline Bytes16 narrow(Shorts8 low, Shorts8 high) {
  return __builtin_shufflevector(reinterpret_cast<Bytes16>(low), reinterpret_cast<Bytes16>(high), 0, 2, 4, 6, 8, 10, 12,
                                 14, 16, 18, 20, 22, 24, 26, 28, 30);
}

static inline std::int16_t least_of(Shorts8 numbers) {
#if defined(__ARM_NEON)
  return vminvq_s16(numbers);
#else
  std::int16_t least = numbers[0];
  for (int i = 1; i < 8; ++i) least = numbers[i] < least ? numbers[i] : least;
  return least;
#endif
}

}  // namespace tact::base

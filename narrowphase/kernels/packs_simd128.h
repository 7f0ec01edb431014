// Packs of two doubles or four floats: NEON, SIMD128 of WebAssembly.
#pragma once

#include <cstdint>
#include <cstring>

#include "engine/base/simd128.h"

namespace tact::narrowphase {
namespace {

constexpr int kVectorBytes = 16;  // of whole numbers
constexpr int kWidth = 2;
using Pack = base::Doubles2;
using Mask = base::Longs2;

inline Pack load(const double* p) { return base::load_as<Pack>(p); }
inline void store(double* p, Pack a) { base::store_as(p, a); }
inline Pack spread(double a) { return Pack{a, a}; }
template <class Index>
inline Pack gather(const double* p, const Index* i) {
  return Pack{p[i[0]], p[i[1]]};
}
// Of points of four numbers each the first three of some.
inline void gather_points(const double* p, const std::uint8_t* i, Pack* xyz) {
  const double *const a = p + 4 * i[0], *const b = p + 4 * i[1];
  const Pack xy_a = load(a), xy_b = load(b);
  xyz[0] = __builtin_shufflevector(xy_a, xy_b, 0, 2);
  xyz[1] = __builtin_shufflevector(xy_a, xy_b, 1, 3);
  xyz[2] = Pack{a[2], b[2]};
}
// Elements of an array.
struct Picks {
  const std::uint8_t* place;
  explicit Picks(const std::uint8_t* p) : place(p) {}
};
inline Pack pick(const double* p, int, const Picks& at) { return gather(p, at.place); }
inline Pack add(Pack a, Pack b) { return a + b; }
inline Pack sub(Pack a, Pack b) { return a - b; }
inline Pack mul(Pack a, Pack b) { return a * b; }
inline Pack div(Pack a, Pack b) { return a / b; }
// a b - c, rounded once.
inline Pack fused(Pack a, Pack b, Pack c) { return base::fused(a, b, -c); }
inline Mask less_equal(Pack a, Pack b) { return a <= b; }
inline Mask less(Pack a, Pack b) { return a < b; }
inline Mask not_equal(Pack a, Pack b) { return a != b; }
inline Mask both(Mask a, Mask b) { return a & b; }
inline Mask either(Mask a, Mask b) { return a | b; }
inline Mask differ(Mask a, Mask b) { return a ^ b; }
inline Mask mask_of(unsigned lanes) { return (Mask{1, 2} & static_cast<std::int64_t>(lanes)) != 0; }
inline unsigned bits(Mask a) { return base::bits_of(a); }
inline Pack select(Mask mask, Pack yes, Pack no) { return base::choose(mask, yes, no); }
// Not the machine's own, which may take the lesser zero or what is no number.
inline Pack min(Pack a, Pack b) { return select(a < b, a, b); }
inline Pack max(Pack a, Pack b) { return select(a > b, a, b); }
inline Pack abs(Pack a) { return reinterpret_cast<Pack>(reinterpret_cast<Mask>(a) & ~(std::int64_t{1} << 63)); }
// Bit k of each byte: mask k.
inline void store_flags(std::uint8_t* p, const Mask (&mask)[7]) {
  Mask flags{};
  for (int k = 0; k < 7; ++k) flags |= mask[k] & std::int64_t{1 << k};
  p[0] = static_cast<std::uint8_t>(flags[0]);
  p[1] = static_cast<std::uint8_t>(flags[1]);
}

// Writes the lanes that have a bit, and first + lane, one after the other; up to kWidth of each. Returns how many.
inline int store_some(unsigned lanes, Pack a, int first, double* value, std::int32_t* index) {
  const bool from_first = (lanes & 1) != 0;
  value[0] = from_first ? a[0] : a[1];
  value[1] = a[1];
  index[0] = from_first ? first : first + 1;
  index[1] = first + 1;
  return __builtin_popcount(lanes);
}

// Four floats at a time.
constexpr int kFloatWidth = 4;
using FloatPack = base::Floats4;
using FloatMask = base::Ints4;
inline FloatPack load(const float* p) { return base::load_as<FloatPack>(p); }
inline void store(float* p, Pack a) { base::store_as(p, __builtin_convertvector(a, base::Floats2)); }
inline FloatPack spread(float a) { return FloatPack{a, a, a, a}; }
struct FloatPicks {
  const std::uint8_t* place;
  explicit FloatPicks(const std::uint8_t* p) : place(p) {}
};
inline FloatPack pick(const float* p, int, const FloatPicks& at) {
  const std::uint8_t* const i = at.place;
  return FloatPack{p[i[0]], p[i[1]], p[i[2]], p[i[3]]};
}
inline FloatPack add(FloatPack a, FloatPack b) { return a + b; }
inline FloatPack sub(FloatPack a, FloatPack b) { return a - b; }
inline FloatPack mul(FloatPack a, FloatPack b) { return a * b; }
// a b - c and a b + c, rounded once.
inline FloatPack fused(FloatPack a, FloatPack b, FloatPack c) { return base::fused(a, b, -c); }
inline FloatPack fused_sum(FloatPack a, FloatPack b, FloatPack c) { return base::fused(a, b, c); }
inline FloatMask less_equal(FloatPack a, FloatPack b) { return a <= b; }
inline FloatMask less(FloatPack a, FloatPack b) { return a < b; }
inline FloatMask both(FloatMask a, FloatMask b) { return a & b; }
inline FloatMask either(FloatMask a, FloatMask b) { return a | b; }
inline FloatMask differ(FloatMask a, FloatMask b) { return a ^ b; }
inline unsigned bits(FloatMask a) { return base::bits_of(a); }
inline FloatPack select(FloatMask mask, FloatPack yes, FloatPack no) { return base::choose(mask, yes, no); }

inline void store_floats(float* p, FloatPack a) { base::store_as(p, a); }
inline FloatPack min(FloatPack a, FloatPack b) { return select(a < b, a, b); }
inline FloatPack max(FloatPack a, FloatPack b) { return select(a > b, a, b); }
inline FloatPack abs(FloatPack a) { return reinterpret_cast<FloatPack>(reinterpret_cast<FloatMask>(a) & 0x7fffffff); }

// Numbers from 0 to 2^15 - 1, without what follows the point.
inline void store_cells(std::int16_t* p, Pack a) {
  const Mask numbers = __builtin_convertvector(a, Mask);
  p[0] = static_cast<std::int16_t>(numbers[0]);
  p[1] = static_cast<std::int16_t>(numbers[1]);
}
inline void store_cells(std::int16_t* p, FloatPack a) {
  base::store_as(p, __builtin_convertvector(__builtin_convertvector(a, FloatMask), base::Shorts4));
}

// For each set of four lanes the bytes of those that are in it, one after the other.
struct LanesInOrder {
  std::uint8_t byte[16][16];
  constexpr LanesInOrder() : byte() {
    for (unsigned lanes = 0; lanes < 16; ++lanes) {
      for (unsigned lane = 0, count = 0; lane < 4; ++lane) {
        if ((lanes >> lane & 1) == 0) continue;
        for (unsigned i = 0; i < 4; ++i) byte[lanes][4 * count + i] = static_cast<std::uint8_t>(4 * lane + i);
        ++count;
      }
    }
  }
};
constexpr LanesInOrder kLanesInOrder;

// Writes the lanes that have a bit one after the other, in their last bits, those of `places`, at which place from
// `place` on; and mark xor (first + lane); up to kFloatWidth of each. Returns how many.
inline int store_keys(unsigned lanes, FloatPack a, int places, int first, int mark, int place, float* key,
                      std::int32_t* index) {
  const FloatMask lane{0, 1, 2, 3}, number = mark ^ (first + lane);
  const auto order = base::load_as<base::Bytes16>(kLanesInOrder.byte[lanes]);
  const auto in_order = [&](FloatMask numbers) {
    return reinterpret_cast<FloatMask>(base::look_up(reinterpret_cast<base::Bytes16>(numbers), order));
  };
  base::store_as(key, (in_order(reinterpret_cast<FloatMask>(a)) & ~places) | (place + lane));
  base::store_as(index, in_order(number));
  return __builtin_popcount(lanes);
}
inline float largest_lane(FloatPack a) {
  const FloatPack two = max(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return two[0] > two[1] ? two[0] : two[1];
}
inline double largest_lane(Pack a) { return a[0] > a[1] ? a[0] : a[1]; }

}  // namespace
}  // namespace tact::narrowphase

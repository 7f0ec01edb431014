// Packs of one element: the twin that the others are held against.
#pragma once

#include <cstdint>

#include "engine/base/fused.h"

namespace tact::narrowphase {
namespace {

constexpr int kVectorBytes = 16;  // of whole numbers
constexpr int kWidth = 1;
using Pack = double;
using Mask = bool;

inline Pack load(const double* p) { return *p; }
inline void store(double* p, Pack a) { *p = a; }
inline Pack spread(double a) { return a; }
template <class Index>
inline Pack gather(const double* p, const Index* index) {
  return p[*index];
}
// Of points of four numbers each the first three of some.
inline void gather_points(const double* p, const std::uint8_t* index, Pack* xyz) {
  for (int axis = 0; axis < 3; ++axis) xyz[axis] = p[4 * *index + axis];
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
inline Pack min(Pack a, Pack b) { return a < b ? a : b; }
inline Pack max(Pack a, Pack b) { return a > b ? a : b; }
inline Pack abs(Pack a) { return __builtin_fabs(a); }
inline Mask less_equal(Pack a, Pack b) { return a <= b; }
inline Mask less(Pack a, Pack b) { return a < b; }
inline Mask not_equal(Pack a, Pack b) { return a != b; }
inline Mask both(Mask a, Mask b) { return a && b; }
inline Mask either(Mask a, Mask b) { return a || b; }
inline Mask differ(Mask a, Mask b) { return a != b; }
inline Mask mask_of(unsigned bits) { return bits != 0; }
inline unsigned bits(Mask a) { return a ? 1u : 0u; }
inline Pack select(Mask mask, Pack yes, Pack no) { return mask ? yes : no; }
// Bit k of each byte: mask k.
inline void store_flags(std::uint8_t* p, const Mask (&mask)[7]) {
  unsigned flags = 0;
  for (int k = 0; k < 7; ++k) flags |= bits(mask[k]) << k;
  *p = static_cast<std::uint8_t>(flags);
}

// Writes the lane if it has a bit, and its number. Returns how many.
inline int store_some(unsigned lanes, Pack a, int first, double* value, std::int32_t* index) {
  *value = a;
  *index = first;
  return static_cast<int>(lanes);
}

constexpr int kFloatWidth = 1;
using FloatPack = float;
using FloatMask = bool;
inline FloatPack load(const float* p) { return *p; }
inline void store(float* p, Pack a) { *p = static_cast<float>(a); }
inline FloatPack spread(float a) { return a; }
struct FloatPicks {
  const std::uint8_t* place;
  explicit FloatPicks(const std::uint8_t* p) : place(p) {}
};
inline FloatPack pick(const float* p, int, const FloatPicks& at) { return p[*at.place]; }
inline FloatPack add(FloatPack a, FloatPack b) { return a + b; }
inline FloatPack sub(FloatPack a, FloatPack b) { return a - b; }
inline FloatPack mul(FloatPack a, FloatPack b) { return a * b; }
inline FloatPack fused(FloatPack a, FloatPack b, FloatPack c) { return base::fused(a, b, -c); }
inline FloatPack fused_sum(FloatPack a, FloatPack b, FloatPack c) { return base::fused(a, b, c); }
inline FloatPack abs(FloatPack a) { return __builtin_fabsf(a); }
inline FloatMask less_equal(FloatPack a, FloatPack b) { return a <= b; }
inline FloatMask less(FloatPack a, FloatPack b) { return a < b; }
inline FloatPack select(FloatMask mask, FloatPack yes, FloatPack no) { return mask ? yes : no; }

inline void store_floats(float* p, FloatPack a) { *p = a; }
inline FloatPack min(FloatPack a, FloatPack b) { return a < b ? a : b; }
inline FloatPack max(FloatPack a, FloatPack b) { return a > b ? a : b; }

// Numbers from 0 to 2^15 - 1, without what follows the point.
inline void store_cells(std::int16_t* p, Pack a) { *p = static_cast<std::int16_t>(a); }
inline void store_cells(std::int16_t* p, FloatPack a) { *p = static_cast<std::int16_t>(a); }
// Writes the lane if it has a bit, in its last bits, those of `places`, at which place; and mark xor its number.
// Returns how many.
inline int store_keys(unsigned lanes, FloatPack a, int places, int first, int mark, int place, float* key,
                      std::int32_t* index) {
  std::int32_t bits_of_key;
  __builtin_memcpy(&bits_of_key, &a, sizeof a);
  bits_of_key = (bits_of_key & ~places) | place;
  __builtin_memcpy(key, &bits_of_key, sizeof a);
  *index = mark ^ first;
  return static_cast<int>(lanes);
}
inline float largest_lane(FloatPack a) { return a; }
inline double largest_lane(Pack a) { return a; }

}  // namespace
}  // namespace tact::narrowphase

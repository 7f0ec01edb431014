// Packs of four doubles or eight floats, for AVX2 and FMA.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace tact::narrowphase {
namespace {

constexpr int kVectorBytes = 32;  // of whole numbers
constexpr int kWidth = 4;
using Pack = __m256d;
using Mask = __m256d;

inline Pack load(const double* p) { return _mm256_loadu_pd(p); }
inline void store(double* p, Pack a) { _mm256_storeu_pd(p, a); }
inline Pack spread(double a) { return _mm256_set1_pd(a); }
template <class Index>
inline Pack gather(const double* p, const Index* i) {
  return _mm256_set_pd(p[i[3]], p[i[2]], p[i[1]], p[i[0]]);
}
// Of points of four numbers each the first three of some.
inline void gather_points(const double* p, const std::uint8_t* i, Pack* xyz) {
  const Pack a = load(p + 4 * i[0]), b = load(p + 4 * i[1]), c = load(p + 4 * i[2]), d = load(p + 4 * i[3]);
  const Pack xz_ab = _mm256_unpacklo_pd(a, b), xz_cd = _mm256_unpacklo_pd(c, d);
  xyz[0] = _mm256_permute2f128_pd(xz_ab, xz_cd, 0x20);
  xyz[1] = _mm256_permute2f128_pd(_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d), 0x20);
  xyz[2] = _mm256_permute2f128_pd(xz_ab, xz_cd, 0x31);
}
// Elements of an array.
struct Picks {
  const std::uint8_t* place;
  explicit Picks(const std::uint8_t* p) : place(p) {}
};
inline Pack pick(const double* p, int, const Picks& at) { return gather(p, at.place); }
inline Pack add(Pack a, Pack b) { return _mm256_add_pd(a, b); }
inline Pack sub(Pack a, Pack b) { return _mm256_sub_pd(a, b); }
inline Pack mul(Pack a, Pack b) { return _mm256_mul_pd(a, b); }
inline Pack div(Pack a, Pack b) { return _mm256_div_pd(a, b); }
// a b - c, rounded once.
inline Pack fused(Pack a, Pack b, Pack c) { return _mm256_fmsub_pd(a, b, c); }
inline Pack min(Pack a, Pack b) { return _mm256_min_pd(a, b); }
inline Pack max(Pack a, Pack b) { return _mm256_max_pd(a, b); }
inline Pack abs(Pack a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
inline Mask less_equal(Pack a, Pack b) { return _mm256_cmp_pd(a, b, _CMP_LE_OQ); }
inline Mask less(Pack a, Pack b) { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
inline Mask not_equal(Pack a, Pack b) { return _mm256_cmp_pd(a, b, _CMP_NEQ_UQ); }
inline Mask both(Mask a, Mask b) { return _mm256_and_pd(a, b); }
inline Mask either(Mask a, Mask b) { return _mm256_or_pd(a, b); }
inline Mask differ(Mask a, Mask b) { return _mm256_xor_pd(a, b); }
inline Mask mask_of(unsigned lanes) {
  const __m256i bit = _mm256_set_epi64x(8, 4, 2, 1);
  return _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(lanes), bit), bit));
}
inline unsigned bits(Mask a) { return static_cast<unsigned>(_mm256_movemask_pd(a)); }
inline Pack select(Mask mask, Pack yes, Pack no) { return _mm256_blendv_pd(no, yes, mask); }
// Bit k of each byte: mask k.
inline void store_flags(std::uint8_t* p, const Mask (&mask)[7]) {
  __m256i flags = _mm256_setzero_si256();
  for (int k = 0; k < 7; ++k) {
    flags = _mm256_or_si256(flags, _mm256_and_si256(_mm256_castpd_si256(mask[k]), _mm256_set1_epi64x(1 << k)));
  }
  const __m128i low = _mm256_castsi256_si128(flags), high = _mm256_extracti128_si256(flags, 1);
  const __m128i byte_of = _mm_setr_epi8(0, 8, 2, 10, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
  const int four = _mm_cvtsi128_si32(_mm_shuffle_epi8(_mm_or_si128(low, _mm_slli_epi64(high, 16)), byte_of));
  __builtin_memcpy(p, &four, sizeof four);
}

// Writes the lanes that have a bit, and first + lane, one after the other. Returns how many.
inline int store_some(unsigned lanes, Pack a, int first, double* value, std::int32_t* index) {
  double lane[kWidth];
  store(lane, a);
  int count = 0;
  for (; lanes != 0; lanes &= lanes - 1, ++count) {
    const int k = __builtin_ctz(lanes);
    value[count] = lane[k];
    index[count] = first + k;
  }
  return count;
}

// Eight floats at a time.
constexpr int kFloatWidth = 8;
using FloatPack = __m256;
using FloatMask = __m256;
inline FloatPack load(const float* p) { return _mm256_loadu_ps(p); }
inline void store(float* p, Pack a) { _mm_storeu_ps(p, _mm256_cvtpd_ps(a)); }
inline FloatPack spread(float a) { return _mm256_set1_ps(a); }
struct FloatPicks {
  const std::uint8_t* place;
  explicit FloatPicks(const std::uint8_t* p) : place(p) {}
};
inline FloatPack pick(const float* p, int, const FloatPicks& at) {
  const std::uint8_t* const i = at.place;
  return _mm256_set_ps(p[i[7]], p[i[6]], p[i[5]], p[i[4]], p[i[3]], p[i[2]], p[i[1]], p[i[0]]);
}
inline FloatPack add(FloatPack a, FloatPack b) { return _mm256_add_ps(a, b); }
inline FloatPack sub(FloatPack a, FloatPack b) { return _mm256_sub_ps(a, b); }
inline FloatPack mul(FloatPack a, FloatPack b) { return _mm256_mul_ps(a, b); }
// a b - c and a b + c, rounded once.
inline FloatPack fused(FloatPack a, FloatPack b, FloatPack c) { return _mm256_fmsub_ps(a, b, c); }
inline FloatPack fused_sum(FloatPack a, FloatPack b, FloatPack c) { return _mm256_fmadd_ps(a, b, c); }
inline FloatPack abs(FloatPack a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
inline FloatMask less_equal(FloatPack a, FloatPack b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
inline FloatMask less(FloatPack a, FloatPack b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
inline FloatMask both(FloatMask a, FloatMask b) { return _mm256_and_ps(a, b); }
inline FloatMask either(FloatMask a, FloatMask b) { return _mm256_or_ps(a, b); }
inline FloatMask differ(FloatMask a, FloatMask b) { return _mm256_xor_ps(a, b); }
inline unsigned bits(FloatMask a) { return static_cast<unsigned>(_mm256_movemask_ps(a)); }
inline FloatPack select(FloatMask mask, FloatPack yes, FloatPack no) { return _mm256_blendv_ps(no, yes, mask); }

inline void store_floats(float* p, FloatPack a) { _mm256_storeu_ps(p, a); }
inline FloatPack min(FloatPack a, FloatPack b) { return _mm256_min_ps(a, b); }
inline FloatPack max(FloatPack a, FloatPack b) { return _mm256_max_ps(a, b); }

// Numbers from 0 to 2^15 - 1, without what follows the point.
inline void store_cells(std::int16_t* p, Pack a) {
  const __m128i numbers = _mm256_cvttpd_epi32(a);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_packs_epi32(numbers, numbers));
}
inline void store_cells(std::int16_t* p, FloatPack a) {
  const __m256i numbers = _mm256_cvttps_epi32(a);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p),
                   _mm_packs_epi32(_mm256_castsi256_si128(numbers), _mm256_extracti128_si256(numbers, 1)));
}
// Writes the lanes that have a bit one after the other, in their last bits, those of `places`, at which place from
// `place` on; and mark xor (first + lane). Returns how many.
inline int store_keys(unsigned lanes, FloatPack a, int places, int first, int mark, int place, float* key,
                      std::int32_t* index) {
  alignas(32) std::int32_t lane[kFloatWidth];
  const __m256i time = _mm256_andnot_si256(_mm256_set1_epi32(places), _mm256_castps_si256(a));
  _mm256_store_si256(reinterpret_cast<__m256i*>(lane), time);
  int count = 0;
  for (; lanes != 0; lanes &= lanes - 1, ++count) {
    const int k = __builtin_ctz(lanes);
    const std::int32_t bits_of_key = lane[k] | (place + count);
    __builtin_memcpy(key + count, &bits_of_key, sizeof bits_of_key);
    index[count] = mark ^ (first + k);
  }
  return count;
}
inline float largest_lane(FloatPack a) {
  const __m128 four = _mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
  const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
}
inline double largest_lane(Pack a) {
  const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
  return _mm_cvtsd_f64(_mm_max_sd(two, _mm_unpackhi_pd(two, two)));
}

}  // namespace
}  // namespace tact::narrowphase

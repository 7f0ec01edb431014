// Packs of eight doubles or sixteen floats, for AVX-512 F, DQ, VL, BW, VBMI and VBMI2.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace tact::narrowphase {
namespace {

constexpr int kVectorBytes = 64;  // of whole numbers
constexpr int kWidth = 8;
using Pack = __m512d;
using Mask = __mmask8;

inline Pack load(const double* p) { return _mm512_loadu_pd(p); }
inline void store(double* p, Pack a) { _mm512_storeu_pd(p, a); }
inline Pack spread(double a) { return _mm512_set1_pd(a); }
// Inlined, or all packs in registers go through memory: nearest points take 1.06 of their time then.
template <class Index>
[[gnu::always_inline]] inline Pack gather(const double* p, const Index* i) {
  return _mm512_set_pd(p[i[7]], p[i[6]], p[i[5]], p[i[4]], p[i[3]], p[i[2]], p[i[1]], p[i[0]]);
}
// Of points of four numbers each the first three of some.
inline void gather_points(const double* p, const std::uint8_t* i, Pack* xyz) {
  const auto two = [&](int k, int n) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(p + 4 * i[k])), _mm256_loadu_pd(p + 4 * i[n]), 1);
  };
  const Pack a = two(0, 4), b = two(1, 5), c = two(2, 6), d = two(3, 7);
  const Pack xz_ab = _mm512_unpacklo_pd(a, b), xz_cd = _mm512_unpacklo_pd(c, d);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  xyz[0] = _mm512_permutex2var_pd(xz_ab, low, xz_cd);
  xyz[1] = _mm512_permutex2var_pd(_mm512_unpackhi_pd(a, b), low, _mm512_unpackhi_pd(c, d));
  xyz[2] = _mm512_permutex2var_pd(xz_ab, high, xz_cd);
}
// Elements of a padded array of up to 64, of which `count` are filled. Short arrays are taken whole into registers.
struct Picks {
  const std::uint8_t* place;
  __m512i index;
  Mask beyond_16;
  explicit Picks(const std::uint8_t* p)
      : place(p),
        index(_mm512_cvtepu8_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)))),
        beyond_16(_mm512_test_epi64_mask(index, _mm512_set1_epi64(16))) {}
};
inline Pack pick(const double* p, int count, const Picks& at) {
  if (count > 32) return gather(p, at.place);
  const Pack first = _mm512_permutex2var_pd(load(p), at.index, load(p + 8));
  if (count <= 16) return first;
  return _mm512_mask_blend_pd(at.beyond_16, first, _mm512_permutex2var_pd(load(p + 16), at.index, load(p + 24)));
}
inline Pack add(Pack a, Pack b) { return _mm512_add_pd(a, b); }
inline Pack sub(Pack a, Pack b) { return _mm512_sub_pd(a, b); }
inline Pack mul(Pack a, Pack b) { return _mm512_mul_pd(a, b); }
inline Pack div(Pack a, Pack b) { return _mm512_div_pd(a, b); }
// a b - c, rounded once.
inline Pack fused(Pack a, Pack b, Pack c) { return _mm512_fmsub_pd(a, b, c); }
inline Pack min(Pack a, Pack b) { return _mm512_min_pd(a, b); }
inline Pack max(Pack a, Pack b) { return _mm512_max_pd(a, b); }
inline Pack abs(Pack a) { return _mm512_abs_pd(a); }
inline Mask less_equal(Pack a, Pack b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
inline Mask less(Pack a, Pack b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
inline Mask not_equal(Pack a, Pack b) { return _mm512_cmp_pd_mask(a, b, _CMP_NEQ_UQ); }
inline Mask both(Mask a, Mask b) { return _kand_mask8(a, b); }
inline Mask either(Mask a, Mask b) { return _kor_mask8(a, b); }
inline Mask differ(Mask a, Mask b) { return _kxor_mask8(a, b); }
inline Mask mask_of(unsigned bits) { return static_cast<Mask>(bits); }
inline unsigned bits(Mask a) { return a; }
inline Pack select(Mask mask, Pack yes, Pack no) { return _mm512_mask_blend_pd(mask, no, yes); }
// Bit k of each byte: mask k.
inline void store_flags(std::uint8_t* p, const Mask (&mask)[7]) {
  __m512i flags = _mm512_setzero_si512();
  for (int k = 0; k < 7; ++k) flags = _mm512_mask_or_epi64(flags, mask[k], flags, _mm512_set1_epi64(1 << k));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm512_cvtepi64_epi8(flags));
}

// Writes the lanes that have a bit, and first + lane, one after the other; up to kWidth of each. Returns how many.
inline int store_some(unsigned lanes, Pack a, int first, double* value, std::int32_t* index) {
  const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm512_storeu_pd(value, _mm512_maskz_compress_pd(static_cast<Mask>(lanes), a));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(index),
                      _mm256_maskz_compress_epi32(static_cast<Mask>(lanes), numbers));
  return __builtin_popcount(lanes);
}

// Sixteen floats at a time.
constexpr int kFloatWidth = 16;
using FloatPack = __m512;
using FloatMask = __mmask16;
inline FloatPack load(const float* p) { return _mm512_loadu_ps(p); }
inline void store(float* p, Pack a) { _mm256_storeu_ps(p, _mm512_cvtpd_ps(a)); }
inline FloatPack spread(float a) { return _mm512_set1_ps(a); }
struct FloatPicks {
  __m512i index;
  FloatMask beyond_32;
  explicit FloatPicks(const std::uint8_t* place)
      : index(_mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(place)))),
        beyond_32(_mm512_test_epi32_mask(index, _mm512_set1_epi32(32))) {}
};
inline FloatPack pick(const float* p, int count, const FloatPicks& at) {
  const FloatPack first = _mm512_permutex2var_ps(_mm512_loadu_ps(p), at.index, _mm512_loadu_ps(p + 16));
  if (count <= 32) return first;
  const FloatPack last = _mm512_permutex2var_ps(_mm512_loadu_ps(p + 32), at.index, _mm512_loadu_ps(p + 48));
  return _mm512_mask_blend_ps(at.beyond_32, first, last);
}
inline FloatPack add(FloatPack a, FloatPack b) { return _mm512_add_ps(a, b); }
inline FloatPack sub(FloatPack a, FloatPack b) { return _mm512_sub_ps(a, b); }
inline FloatPack mul(FloatPack a, FloatPack b) { return _mm512_mul_ps(a, b); }
// a b - c and a b + c, rounded once.
inline FloatPack fused(FloatPack a, FloatPack b, FloatPack c) { return _mm512_fmsub_ps(a, b, c); }
inline FloatPack fused_sum(FloatPack a, FloatPack b, FloatPack c) { return _mm512_fmadd_ps(a, b, c); }
inline FloatPack abs(FloatPack a) { return _mm512_abs_ps(a); }
inline FloatMask less_equal(FloatPack a, FloatPack b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
inline FloatMask less(FloatPack a, FloatPack b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
inline FloatMask both(FloatMask a, FloatMask b) { return _kand_mask16(a, b); }
inline FloatMask either(FloatMask a, FloatMask b) { return _kor_mask16(a, b); }
inline FloatMask differ(FloatMask a, FloatMask b) { return _kxor_mask16(a, b); }
inline unsigned bits(FloatMask a) { return a; }
inline FloatPack select(FloatMask mask, FloatPack yes, FloatPack no) { return _mm512_mask_blend_ps(mask, no, yes); }

inline void store_floats(float* p, FloatPack a) { _mm512_storeu_ps(p, a); }
inline FloatPack min(FloatPack a, FloatPack b) { return _mm512_min_ps(a, b); }
inline FloatPack max(FloatPack a, FloatPack b) { return _mm512_max_ps(a, b); }

// Numbers from 0 to 2^15 - 1, without what follows the point.
inline void store_cells(std::int16_t* p, Pack a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm256_cvtepi32_epi16(_mm512_cvttpd_epi32(a)));
}
inline void store_cells(std::int16_t* p, FloatPack a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm512_cvtepi32_epi16(_mm512_cvttps_epi32(a)));
}
// Writes the lanes that have a bit one after the other, in their last bits, those of `places`, at which place from
// `place` on; and mark xor (first + lane); up to kFloatWidth of each. Returns how many.
inline int store_keys(unsigned lanes, FloatPack a, int places, int first, int mark, int place, float* key,
                      std::int32_t* index) {
  const auto some = static_cast<FloatMask>(lanes);
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i number = _mm512_xor_si512(_mm512_set1_epi32(mark), _mm512_add_epi32(_mm512_set1_epi32(first), lane));
  const __m512i in_order = _mm512_castps_si512(_mm512_maskz_compress_ps(some, a));
  const __m512i at = _mm512_add_epi32(_mm512_set1_epi32(place), lane);
  _mm512_storeu_si512(key, _mm512_or_si512(_mm512_andnot_si512(_mm512_set1_epi32(places), in_order), at));
  _mm512_storeu_si512(index, _mm512_maskz_compress_epi32(some, number));
  return __builtin_popcount(lanes);
}
inline float largest_lane(FloatPack a) { return _mm512_reduce_max_ps(a); }
inline double largest_lane(Pack a) { return _mm512_reduce_max_pd(a); }

}  // namespace
}  // namespace tact::narrowphase

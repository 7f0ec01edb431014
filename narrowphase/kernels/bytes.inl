// Loops over small whole numbers: a byte a vertex of flags, a byte a corner of a facet, cells of
// boxes.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/packs.h"

namespace tact::narrowphase {
namespace {

// For each facet i < count a bit in `none` if the flags of its three corners, flags[corner[k][i]], have no bit in
// common, and a bit in `lowest` if they have the lowest bit in common.
struct CommonFlags {
  std::uint64_t none, lowest;
};

inline CommonFlags common_flags_one_by_one(const std::uint8_t* flags, const std::uint8_t* const (&corner)[3],
                                           int count) {
  CommonFlags found{0, 0};
  for (int i = 0; i < count; ++i) {
    const unsigned common = flags[corner[0][i]] & flags[corner[1][i]] & flags[corner[2][i]];
    found.none |= static_cast<std::uint64_t>(common == 0) << i;
    found.lowest |= static_cast<std::uint64_t>(common & 1) << i;
  }
  return found;
}

#if defined(TACT_KERNELS_AVX512)

// Up to 128 flags stand in two registers. At least 128 bytes of flags can be read, and 1 <= count <= 64.
inline CommonFlags common_flags(const std::uint8_t* flags, int flag_count, const std::uint8_t* const (&corner)[3],
                                int count) {
  if (flag_count > 128) return common_flags_one_by_one(flags, corner, count);
  const __mmask64 all = ~std::uint64_t{0} >> (64 - count);
  const __m512i low = _mm512_loadu_si512(flags), high = _mm512_loadu_si512(flags + 64);
  const auto of_corner = [&](int k) {
    return _mm512_permutex2var_epi8(low, _mm512_maskz_loadu_epi8(all, corner[k]), high);
  };
  const __m512i common = _mm512_and_si512(_mm512_and_si512(of_corner(0), of_corner(1)), of_corner(2));
  return {_mm512_mask_testn_epi8_mask(all, common, common),
          _mm512_mask_test_epi8_mask(all, common, _mm512_set1_epi8(1))};
}

// Copies those of up to 64 bytes that have a bit, one after the other. Writes 64 bytes.
inline void compress(std::uint64_t set, const std::uint8_t* from, std::uint8_t* to) {
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi8(set, _mm512_maskz_loadu_epi8(set, from)));
}

struct Places {
  std::uint8_t place[64];
  constexpr Places() : place() {
    for (int i = 0; i < 64; ++i) place[i] = static_cast<std::uint8_t>(i);
  }
};

// The places of the bits that are set, ascending. Writes 64 bytes.
inline void write_places(std::uint64_t set, std::uint8_t* to) {
  static constexpr Places kPlaces;
  compress(set, kPlaces.place, to);
}

#elif defined(TACT_KERNELS_AVX2)

// Sixteen flags at a time stand in both halves of a register. A shuffle takes the low four bits of a place and gives
// zero where the highest is set: so it is after a saturated sum in all places but those of the sixteen.
inline CommonFlags common_flags(const std::uint8_t* flags, int flag_count, const std::uint8_t* const (&corner)[3],
                                int count) {
  CommonFlags found{0, 0};
  for (int begin = 0; begin < count; begin += 32) {
    __m256i place[3], of_corner[3];
    for (int k = 0; k < 3; ++k) {
      place[k] = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(corner[k] + begin));
      of_corner[k] = _mm256_setzero_si256();
    }
    for (int first = 0; first < flag_count; first += 16) {
      const __m256i here =
          _mm256_broadcastsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(flags + first)));
      for (int k = 0; k < 3; ++k) {
        const __m256i one = _mm256_shuffle_epi8(here, _mm256_adds_epu8(place[k], _mm256_set1_epi8(0x70)));
        of_corner[k] = _mm256_or_si256(of_corner[k], one);
        place[k] = _mm256_sub_epi8(place[k], _mm256_set1_epi8(16));
      }
    }
    const __m256i common = _mm256_and_si256(_mm256_and_si256(of_corner[0], of_corner[1]), of_corner[2]);
    const __m256i none = _mm256_cmpeq_epi8(common, _mm256_setzero_si256()), lowest = _mm256_slli_epi16(common, 7);
    found.none |= std::uint64_t{static_cast<std::uint32_t>(_mm256_movemask_epi8(none))} << begin;
    found.lowest |= std::uint64_t{static_cast<std::uint32_t>(_mm256_movemask_epi8(lowest))} << begin;
  }
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
  return {found.none & all, found.lowest & all};
}

inline void shuffle_eight(const std::uint8_t* from, const std::uint64_t* places, std::uint8_t* to) {
  const __m128i eight = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
  const __m128i order = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(places));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_shuffle_epi8(eight, order));
}

#elif defined(TACT_KERNELS_SIMD128)

inline CommonFlags common_flags(const std::uint8_t* flags, int flag_count, const std::uint8_t* const (&corner)[3],
                                int count) {
  base::Bytes16 none[4] = {}, lowest[4] = {};
  for (int k = 0; 16 * k < count; ++k) {
    const auto of_corner = [&](int c) {
      return base::look_up(flags, flag_count, base::load_as<base::Bytes16>(corner[c] + 16 * k));
    };
    const base::Bytes16 common = of_corner(0) & of_corner(1) & of_corner(2);
    none[k] = reinterpret_cast<base::Bytes16>(common == 0);
    lowest[k] = reinterpret_cast<base::Bytes16>((common & 1) != 0);
  }
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
  return {base::bits_of(none) & all, base::bits_of(lowest) & all};
}

inline void shuffle_eight(const std::uint8_t* from, const std::uint64_t* places, std::uint8_t* to) {
  const base::Bytes16 eight = base::load_eight(from), order = base::load_eight(places);
  base::store_eight(to, base::look_up(eight, order));
}

#else

inline CommonFlags common_flags(const std::uint8_t* flags, int, const std::uint8_t* const (&corner)[3], int count) {
  return common_flags_one_by_one(flags, corner, count);
}

inline void compress(std::uint64_t set, const std::uint8_t* from, std::uint8_t* to) {
  for (; set != 0; set &= set - 1) *to++ = from[__builtin_ctzll(set)];
}

inline void write_places(std::uint64_t set, std::uint8_t* to) {
  for (; set != 0; set &= set - 1) *to++ = static_cast<std::uint8_t>(__builtin_ctzll(set));
}

#endif

#if defined(TACT_KERNELS_AVX2) || defined(TACT_KERNELS_SIMD128)

// The places of the bits of each byte, ascending, a byte each.
struct PlacesInByte {
  std::uint64_t of[256];
  constexpr PlacesInByte() : of() {
    for (unsigned byte = 0; byte < 256; ++byte) {
      int count = 0;
      for (std::uint64_t place = 0; place < 8; ++place) {
        if ((byte >> place & 1) != 0) of[byte] |= place << 8 * count++;
      }
    }
  }
};
constexpr PlacesInByte kPlacesInByte;

// Copies those of up to 64 bytes that have a bit, one after the other. Reads and writes up to 64 bytes.
inline void compress(std::uint64_t set, const std::uint8_t* from, std::uint8_t* to) {
  for (; set != 0; set >>= 8, from += 8) {
    const std::uint64_t byte = set & 0xff;
    shuffle_eight(from, kPlacesInByte.of + byte, to);
    to += __builtin_popcountll(byte);
  }
}

// The places of the bits that are set, ascending. Writes up to 64 bytes.
inline void write_places(std::uint64_t set, std::uint8_t* to) {
  for (std::uint64_t first = 0; set != 0; set >>= 8, first += 0x0808080808080808) {
    const std::uint64_t byte = set & 0xff, places = kPlacesInByte.of[byte] + first;
    __builtin_memcpy(to, &places, sizeof places);
    to += __builtin_popcountll(byte);
  }
}

#endif

// A bit for each of the facets that reaches into `cells`, and for some beyond them.
#if defined(TACT_KERNELS_AVX512)

inline std::uint64_t sharing_cells(const CellBox& cells, const FacetCells& facets) {
  const auto half = [&](int begin) {
    __mmask32 shared = ~__mmask32{0};
    for (int axis = 0; axis < 3; ++axis) {
      const __m512i lower = _mm512_set1_epi16(cells.lower[axis]), upper = _mm512_set1_epi16(cells.upper[axis]);
      shared = _mm512_mask_cmple_epi16_mask(shared, _mm512_load_si512(facets.lower[axis] + begin), upper);
      shared = _mm512_mask_cmple_epi16_mask(shared, lower, _mm512_load_si512(facets.upper[axis] + begin));
    }
    return std::uint64_t{shared};
  };
  return facets.count <= 32 ? half(0) : half(0) | half(32) << 32;
}

#elif defined(TACT_KERNELS_AVX2)

inline std::uint64_t sharing_cells(const CellBox& cells, const FacetCells& facets) {
  const auto half = [&](int begin) {
    __m256i apart[2] = {_mm256_setzero_si256(), _mm256_setzero_si256()};
    for (int axis = 0; axis < 3; ++axis) {
      const __m256i lower = _mm256_set1_epi16(cells.lower[axis]), upper = _mm256_set1_epi16(cells.upper[axis]);
      for (int k = 0; k < 2; ++k) {
        const auto at = [&](const std::int16_t* cell) {
          return _mm256_load_si256(reinterpret_cast<const __m256i*>(cell + begin + 16 * k));
        };
        const __m256i above = _mm256_cmpgt_epi16(at(facets.lower[axis]), upper);
        const __m256i below = _mm256_cmpgt_epi16(lower, at(facets.upper[axis]));
        apart[k] = _mm256_or_si256(apart[k], _mm256_or_si256(above, below));
      }
    }
    const __m256i bytes = _mm256_permute4x64_epi64(_mm256_packs_epi16(apart[0], apart[1]), 0b11011000);
    return std::uint64_t{~static_cast<std::uint32_t>(_mm256_movemask_epi8(bytes))};
  };
  return facets.count <= 32 ? half(0) : half(0) | half(32) << 32;
}

#elif defined(TACT_KERNELS_SIMD128)

inline std::uint64_t sharing_cells(const CellBox& cells, const FacetCells& facets) {
  base::Bytes16 shared[4] = {};
  for (int k = 0; 16 * k < facets.count; ++k) {
    base::Shorts8 apart[2] = {};
    for (int axis = 0; axis < 3; ++axis) {
      for (int half = 0; half < 2; ++half) {
        const int i = 16 * k + 8 * half;
        apart[half] |= base::load_as<base::Shorts8>(facets.lower[axis] + i) > cells.upper[axis];
        apart[half] |= base::load_as<base::Shorts8>(facets.upper[axis] + i) < cells.lower[axis];
      }
    }
    shared[k] = ~base::narrow(apart[0], apart[1]);
  }
  return base::bits_of(shared);
}

#else

inline std::uint64_t sharing_cells(const CellBox& cells, const FacetCells& facets) {
  std::uint64_t shared = 0;
  for (int i = 0; i < facets.count; ++i) {
    bool all = true;
    for (int axis = 0; axis < 3; ++axis) {
      all &= facets.lower[axis][i] <= cells.upper[axis] && cells.lower[axis] <= facets.upper[axis][i];
    }
    shared |= std::uint64_t{all} << i;
  }
  return shared;
}

#endif

// The cells that those facets reach that have a bit.
#if defined(TACT_KERNELS_AVX512) || defined(TACT_KERNELS_AVX2)

// The least of numbers from 0 to 2^15 - 1.
inline std::int16_t least(__m256i numbers) {
  const __m128i eight = _mm_min_epi16(_mm256_castsi256_si128(numbers), _mm256_extracti128_si256(numbers, 1));
  return static_cast<std::int16_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(eight)));
}

CellBox cells_of(const FacetCells& facets, std::uint64_t some) {
  const __m256i last = _mm256_set1_epi16(0x7fff);
  __m256i lower[3] = {last, last, last}, opposite_upper[3] = {last, last, last};
  const __m256i bit = _mm256_setr_epi16(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, -32768);
  for (int i = 0; i < facets.count; i += 16) {
    const __m256i bits = _mm256_set1_epi16(static_cast<std::int16_t>(some >> i));
    const __m256i out = _mm256_cmpeq_epi16(_mm256_and_si256(bits, bit), _mm256_setzero_si256());
    const auto widen = [&](__m256i* least, __m256i cells) {
      *least = _mm256_min_epi16(*least, _mm256_blendv_epi8(cells, last, out));
    };
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](const std::int16_t* cell) {
        return _mm256_load_si256(reinterpret_cast<const __m256i*>(cell + i));
      };
      widen(&lower[axis], at(facets.lower[axis]));
      widen(&opposite_upper[axis], _mm256_sub_epi16(last, at(facets.upper[axis])));
    }
  }
  CellBox cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lower[axis] = least(lower[axis]);
    cells.upper[axis] = static_cast<std::int16_t>(0x7fff - least(opposite_upper[axis]));
  }
  return cells;
}

#elif defined(TACT_KERNELS_SIMD128)

CellBox cells_of(const FacetCells& facets, std::uint64_t some) {
  const auto spread_short = [](std::int16_t a) { return base::Shorts8{a, a, a, a, a, a, a, a}; };
  const base::Shorts8 last = spread_short(0x7fff), bit{1, 2, 4, 8, 16, 32, 64, 128};
  base::Shorts8 lower[3] = {last, last, last}, opposite_upper[3] = {last, last, last};
  for (int i = 0; i < facets.count; i += 8) {
    const base::Shorts8 out = (spread_short(static_cast<std::int16_t>(some >> i & 0xff)) & bit) == 0;
    const auto widen = [&](base::Shorts8* least, base::Shorts8 cells) {
      const base::Shorts8 reached = base::choose(out, last, cells);
      *least = base::choose(reached < *least, reached, *least);
    };
    for (int axis = 0; axis < 3; ++axis) {
      widen(&lower[axis], base::load_as<base::Shorts8>(facets.lower[axis] + i));
      widen(&opposite_upper[axis], last - base::load_as<base::Shorts8>(facets.upper[axis] + i));
    }
  }
  CellBox cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lower[axis] = base::least_of(lower[axis]);
    cells.upper[axis] = static_cast<std::int16_t>(0x7fff - base::least_of(opposite_upper[axis]));
  }
  return cells;
}

#else

CellBox cells_of(const FacetCells& facets, std::uint64_t some) {
  CellBox cells{{0x7fff, 0x7fff, 0x7fff}, {0, 0, 0}};
  for (; some != 0; some &= some - 1) {
    const int i = __builtin_ctzll(some);
    for (int axis = 0; axis < 3; ++axis) {
      if (facets.lower[axis][i] < cells.lower[axis]) cells.lower[axis] = facets.lower[axis][i];
      if (cells.upper[axis] < facets.upper[axis][i]) cells.upper[axis] = facets.upper[axis][i];
    }
  }
  return cells;
}

#endif

// The k-th bit goes to where the k-th bit of `set` is.
inline std::uint64_t expand(std::uint64_t bits, std::uint64_t set) {
#if defined(__BMI2__)
  return _pdep_u64(bits, set);
#else
  std::uint64_t result = 0;
  for (; set != 0; set &= set - 1, bits >>= 1) result |= (bits & 1) != 0 ? set & -set : 0;
  return result;
#endif
}

}  // namespace
}  // namespace tact::narrowphase

// Loops over the bytes of a cluster, included by kernels.inl: a byte a vertex of flags, a byte a corner of a facet.

// A bit for each i < count of which the flags of its three corners, flags[corner[k][i]], have no bit in common.
inline std::uint64_t sharing_no_bit_one_by_one(const std::uint8_t* flags, const std::uint8_t* const (&corner)[3],
                                               int count) {
  std::uint64_t none = 0;
  for (int i = 0; i < count; ++i) {
    const unsigned common = flags[corner[0][i]] & flags[corner[1][i]] & flags[corner[2][i]];
    none |= static_cast<std::uint64_t>(common == 0) << i;
  }
  return none;
}

#if defined(TACT_KERNELS_AVX512_BYTES)

// Up to 128 flags stand in two registers. At least 128 bytes of flags can be read, and 1 <= count <= 64.
inline std::uint64_t sharing_no_bit(const std::uint8_t* flags, int flag_count, const std::uint8_t* const (&corner)[3],
                                    int count) {
  if (flag_count > 128) return sharing_no_bit_one_by_one(flags, corner, count);
  const __mmask64 all = ~std::uint64_t{0} >> (64 - count);
  const __m512i low = _mm512_loadu_si512(flags), high = _mm512_loadu_si512(flags + 64);
  const auto of_corner = [&](int k) {
    return _mm512_permutex2var_epi8(low, _mm512_maskz_loadu_epi8(all, corner[k]), high);
  };
  const __m512i common = _mm512_and_si512(_mm512_and_si512(of_corner(0), of_corner(1)), of_corner(2));
  return _mm512_mask_testn_epi8_mask(all, common, common);
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

#else

inline std::uint64_t sharing_no_bit(const std::uint8_t* flags, int, const std::uint8_t* const (&corner)[3], int count) {
  return sharing_no_bit_one_by_one(flags, corner, count);
}

inline void compress(std::uint64_t set, const std::uint8_t* from, std::uint8_t* to) {
  for (; set != 0; set &= set - 1) *to++ = from[__builtin_ctzll(set)];
}

inline void write_places(std::uint64_t set, std::uint8_t* to) {
  for (; set != 0; set &= set - 1) *to++ = static_cast<std::uint8_t>(__builtin_ctzll(set));
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

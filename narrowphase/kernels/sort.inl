// Sorting pairs of facets.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/packs.h"

namespace tact::narrowphase {
namespace {

// How many of the keys are less than each. All are compared with all, which for so few is less work than the branches
// of sorting, none of which can be foreseen. Vectors of GCC's: a comparison gives -1 where it holds.
template <class Key>
inline void count_lesser(const Key* key, int count, Key* lesser) {
  using Keys [[gnu::vector_size(kVectorBytes)]] = Key;
  constexpr int kKeys = sizeof(Keys) / sizeof(Key);
  for (int i = 0; i < count; i += kKeys) {
    Keys keys, found{};
    __builtin_memcpy(&keys, key + i, sizeof keys);
    for (int j = 0; j < count; ++j) found -= keys > key[j];
    __builtin_memcpy(lesser + i, &found, sizeof found);
  }
}

// Each pair's place is the number of pairs that come before it.
template <class Key>
inline void sort_by_keys(FacetPair* pairs, int count, int bits_b) {
  alignas(64) Key key[kMostSorted] = {}, before[kMostSorted];
  for (int i = 0; i < count; ++i) key[i] = static_cast<Key>(pairs[i].a) << bits_b | static_cast<Key>(pairs[i].b);
  count_lesser(key, count, before);
  const Key low = (Key{1} << bits_b) - 1;
  for (int i = 0; i < count; ++i)
    pairs[before[i]] = {static_cast<int>(key[i] >> bits_b), static_cast<int>(key[i] & low)};
}

void sort_pairs(FacetPair* pairs, int count) {
  unsigned all_a = 1, all_b = 1;
  bool sorted = true;
  for (int i = 0; i < count; ++i) {
    all_a |= static_cast<unsigned>(pairs[i].a);
    all_b |= static_cast<unsigned>(pairs[i].b);
    sorted &= i == 0 || pairs[i - 1].a < pairs[i].a || (pairs[i - 1].a == pairs[i].a && pairs[i - 1].b < pairs[i].b);
  }
  if (sorted) return;
  const int bits_a = 32 - __builtin_clz(all_a), bits_b = 32 - __builtin_clz(all_b);
  if (bits_a + bits_b < 32) {
    sort_by_keys<std::int32_t>(pairs, count, bits_b);
  } else {
    sort_by_keys<std::int64_t>(pairs, count, bits_b);
  }
}

}  // namespace
}  // namespace tact::narrowphase

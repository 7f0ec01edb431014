// Sorting pairs of facets, included by kernels.inl.

// Each pair's place is the number of pairs that come before it: all are compared with all, which for so few is less
// work than the branches of sorting, none of which can be foreseen.
void sort_pairs(FacetPair* pairs, int count) {
  alignas(64) std::int64_t key[kMostSorted];
  alignas(64) std::int64_t before[kMostSorted];
  for (int i = 0; i < count; ++i) {
    key[i] = static_cast<std::int64_t>(pairs[i].a) << 32 | static_cast<std::uint32_t>(pairs[i].b);
    before[i] = 0;
  }
  for (int j = 0; j < count; ++j) {
    const std::int64_t other = key[j];
    for (int i = 0; i < count; ++i) before[i] += other < key[i] ? 1 : 0;
  }
  for (int i = 0; i < count; ++i) pairs[before[i]] = {static_cast<int>(key[i] >> 32), static_cast<int>(key[i])};
}

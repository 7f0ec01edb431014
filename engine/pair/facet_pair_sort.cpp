#include "engine/pair/facet_pair_sort.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <span>

#include "narrowphase/kernels/kernels.h"

namespace tact {

void sort_facet_pairs(std::vector<FacetPair>& pairs, int facets_a, int facets_b, base::KeySorter& sorter, int threads) {
  using narrowphase::kernels, narrowphase::kMostSorted;
  if (pairs.size() <= kMostSorted) return kernels().sort_pairs(pairs.data(), static_cast<int>(pairs.size()));
  const auto bits_a = std::bit_width(static_cast<unsigned>(facets_a)),
             bits_b = std::bit_width(static_cast<unsigned>(facets_b));
  const std::span<std::uint64_t> keys = sorter.keys(pairs.size());
  std::ranges::transform(pairs, keys.begin(), [&](const FacetPair& pair) {
    return static_cast<std::uint64_t>(pair.a) << bits_b | static_cast<std::uint64_t>(pair.b);
  });
  std::ranges::transform(sorter.sort(bits_a + bits_b, threads), pairs.begin(), [&](std::uint64_t key) {
    return FacetPair{static_cast<int>(key >> bits_b), static_cast<int>(key & ((std::uint64_t{1} << bits_b) - 1))};
  });
}

void split_off_bare(const narrowphase::ClusteredMesh& a, const narrowphase::ClusteredMesh& b,
                    std::vector<FacetPair>& pairs, std::vector<FacetPair>& bare) {
  bare.clear();
  if (a.has_surface_alone() && b.has_surface_alone()) return;
  const auto is_bare = [&](const FacetPair& pair) { return !a.is_of_surface(pair.a) || !b.is_of_surface(pair.b); };
  std::ranges::copy_if(pairs, std::back_inserter(bare), is_bare);
  std::erase_if(pairs, is_bare);
}

std::span<const FacetPair> with_bare(const std::vector<FacetPair>& pairs, const std::vector<FacetPair>& bare,
                                     std::vector<FacetPair>& room) {
  if (bare.empty()) return pairs;
  room.clear();
  std::ranges::merge(pairs, bare, std::back_inserter(room));
  return room;
}

}  // namespace tact

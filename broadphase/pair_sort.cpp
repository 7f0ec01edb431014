#include "broadphase/pair_sort.h"

#include <algorithm>
#include <bit>

namespace tact::broadphase {

std::span<const IndexPair> PairSorter::sort(std::span<const PairList> parts, std::size_t index_count, int threads) {
  std::size_t count = 0;
  for (const PairList& part : parts) count += part.pairs().size();
  if (pairs_.size() < count) pairs_.resize(count + count / 4);
  const int index_bits = std::max(1, static_cast<int>(std::bit_width(index_count)));
  std::uint64_t* key = sorter_.keys(count).data();
  for (const PairList& part : parts) {
    for (const IndexPair pair : part.pairs()) *key++ = std::uint64_t{pair.a} << index_bits | pair.b;
  }
  const std::span<const std::uint64_t> sorted = sorter_.sort(2 * index_bits, threads);
  const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
  for (std::size_t i = 0; i < count; ++i) {
    pairs_[i] = {static_cast<std::uint32_t>(sorted[i] >> index_bits),
                 static_cast<std::uint32_t>(sorted[i] & index_mask)};
  }
  return {pairs_.data(), count};
}

}  // namespace tact::broadphase

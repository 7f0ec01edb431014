#include "broadphase/pair_sort.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/base/parallel.h"

namespace tact::broadphase {
namespace {

constexpr int kDigitBits = 12;            // counters of a digit fit in the first level of cache
constexpr std::size_t kSlice = 1u << 14;  // keys for which a slice of its own is worth a thread

}  // namespace

std::span<const IndexPair> PairSorter::sort(std::span<const PairList> parts, std::size_t index_count, int threads) {
  std::size_t count = 0;
  for (const PairList& part : parts) count += part.pairs().size();
  if (pairs_.size() < count) {
    from_.resize(count + count / 4);
    to_.resize(from_.size());
    pairs_.resize(from_.size());
  }
  const int index_bits = std::max(1, static_cast<int>(std::bit_width(index_count)));
  std::uint64_t* key = from_.data();
  for (const PairList& part : parts) {
    for (const IndexPair pair : part.pairs()) *key++ = std::uint64_t{pair.a} << index_bits | pair.b;
  }
  const int passes = (2 * index_bits + kDigitBits - 1) / kDigitBits;
  const int digit_bits = (2 * index_bits + passes - 1) / passes;
  for (int i = 0; i < passes && count > 1; ++i) pass(count, i * digit_bits, digit_bits, threads);
  const std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;
  for (std::size_t i = 0; i < count; ++i) {
    pairs_[i] = {static_cast<std::uint32_t>(from_[i] >> index_bits), static_cast<std::uint32_t>(from_[i] & index_mask)};
  }
  return {pairs_.data(), count};
}

// Sorts by one digit. Each slice of the keys is counted and moved by one thread; keys of equal digits keep their order.
void PairSorter::pass(std::size_t count, int shift, int bits, int threads) {
  const std::size_t slices = std::clamp<std::size_t>(count / kSlice, 1, static_cast<std::size_t>(std::max(threads, 1)));
  const std::size_t values = std::size_t{1} << bits;
  const auto begin_of = [&](std::size_t slice) { return count * slice / slices; };
  positions_.assign(slices * values, 0);
  base::parallel_for(slices, 1, threads, [&](std::size_t slice) {
    std::size_t* counts = &positions_[slice * values];
    const std::uint64_t* keys = from_.data();
    const std::uint64_t mask = values - 1;
    const std::size_t end = begin_of(slice + 1);
    for (std::size_t i = begin_of(slice); i < end; ++i) ++counts[keys[i] >> shift & mask];
  });
  std::size_t next = 0;
  for (std::size_t value = 0; value < values; ++value) {
    for (std::size_t slice = 0; slice < slices; ++slice)
      next += std::exchange(positions_[slice * values + value], next);
  }
  base::parallel_for(slices, 1, threads, [&](std::size_t slice) {
    std::size_t* position = &positions_[slice * values];
    const std::uint64_t* keys = from_.data();
    std::uint64_t* sorted = to_.data();
    const std::uint64_t mask = values - 1;
    const std::size_t end = begin_of(slice + 1);
    for (std::size_t i = begin_of(slice); i < end; ++i) {
      const std::uint64_t key = keys[i];
      sorted[position[key >> shift & mask]++] = key;
    }
  });
  std::swap(from_, to_);
}

}  // namespace tact::broadphase

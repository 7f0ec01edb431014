#include "engine/base/key_sort.h"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.h"

namespace tact::base {
namespace {

constexpr int kDigitBits = 12;            // counters of a digit fit in the first level of cache
constexpr int kFewDigitBits = 8;          // of few keys, the counters would cost more than the passes they save
constexpr std::size_t kSlice = 1u << 14;  // keys for which a slice of its own is worth a thread
constexpr std::size_t kFewestRoom = 4096;

}  // namespace

std::span<std::uint64_t> KeySorter::keys(std::size_t count) {
  if (from_.size() < count) {
    to_.resize(std::max(count + count / 4, kFewestRoom));
    from_.resize(to_.size());  // last: it tells how much room there is
  }
  count_ = count;
  return {from_.data(), count};
}

std::span<std::uint64_t> KeySorter::sort(int bits, int threads) {
  const int most = count_ < kSlice ? kFewDigitBits : kDigitBits;
  const int passes = (bits + most - 1) / most, digit_bits = (bits + passes - 1) / passes;
  for (int i = 0; i < passes && count_ > 1; ++i) pass(i * digit_bits, digit_bits, threads);
  return {from_.data(), count_};
}

// Sorts by one digit. Each slice of the keys is counted and moved by one thread; keys of equal digits keep their order.
void KeySorter::pass(int shift, int bits, int threads) {
  const std::size_t slices =
      std::clamp<std::size_t>(count_ / kSlice, 1, static_cast<std::size_t>(std::max(threads, 1)));
  const std::size_t values = std::size_t{1} << bits;
  const auto begin_of = [&](std::size_t slice) { return count_ * slice / slices; };
  positions_.assign(slices * values, 0);
  parallel_for(slices, 1, threads, [&](std::size_t slice) {
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
  parallel_for(slices, 1, threads, [&](std::size_t slice) {
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

}  // namespace tact::base

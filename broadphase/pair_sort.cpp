#include "broadphase/pair_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "engine/base/parallel.h"

namespace tact::broadphase {
namespace {

constexpr int kDigitBits = 11;
constexpr std::size_t kSlice = 1u << 15;  // pairs for which a slice of its own is worth a thread

}  // namespace

std::span<const IndexPair> PairSorter::sort(std::span<const PairList> parts, std::size_t index_count, int threads) {
  std::size_t count = 0;
  for (const PairList& part : parts) count += part.pairs().size();
  if (from_.size() < count) {
    from_.resize(count + count / 4);
    to_.resize(from_.size());
  }
  std::size_t end = 0;
  for (const PairList& part : parts) {
    std::copy(part.pairs().begin(), part.pairs().end(), from_.begin() + static_cast<std::ptrdiff_t>(end));
    end += part.pairs().size();
  }
  if (count > 1) {
    const int bits = std::max(1, static_cast<int>(std::bit_width(index_count - 1)));
    const int passes = (bits + kDigitBits - 1) / kDigitBits;
    const int digit_bits = (bits + passes - 1) / passes;
    for (const auto field : {&IndexPair::b, &IndexPair::a}) {
      for (int i = 0; i < passes; ++i) pass(count, {field, i * digit_bits, digit_bits}, threads);
    }
  }
  return {from_.data(), count};
}

void PairSorter::pass(std::size_t count, Digit digit, int threads) {
  const std::size_t slices = std::clamp<std::size_t>(count / kSlice, 1, static_cast<std::size_t>(std::max(threads, 1)));
  const std::size_t values = std::size_t{1} << digit.bits;
  const auto value_of = [&](const IndexPair& pair) { return (pair.*digit.field >> digit.shift) & (values - 1); };
  const auto begin_of = [&](std::size_t slice) { return count * slice / slices; };
  positions_.assign(slices * values, 0);
  base::parallel_for(slices, 1, threads, [&](std::size_t slice) {
    std::size_t* counts = &positions_[slice * values];
    for (std::size_t i = begin_of(slice); i < begin_of(slice + 1); ++i) ++counts[value_of(from_[i])];
  });
  std::size_t next = 0;
  for (std::size_t value = 0; value < values; ++value) {
    for (std::size_t slice = 0; slice < slices; ++slice) {
      next += std::exchange(positions_[slice * values + value], next);
    }
  }
  base::parallel_for(slices, 1, threads, [&](std::size_t slice) {
    std::size_t* position = &positions_[slice * values];
    for (std::size_t i = begin_of(slice); i < begin_of(slice + 1); ++i) to_[position[value_of(from_[i])]++] = from_[i];
  });
  std::swap(from_, to_);
}

}  // namespace tact::broadphase

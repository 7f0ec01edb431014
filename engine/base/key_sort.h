// Sorts keys of 64 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tact::base {

class KeySorter {
 public:
  // Room for `count` keys, to be written before sort(). Valid until the next call.
  std::span<std::uint64_t> keys(std::size_t count);
  // The keys, sorted; all are below 2^bits. Valid until the next call. A radix sort from the lowest digit up, stable,
  // so that it needs no comparison.
  std::span<std::uint64_t> sort(int bits, int threads);

 private:
  void pass(int shift, int bits, int threads);

  std::size_t count_ = 0;
  std::vector<std::uint64_t> from_;
  std::vector<std::uint64_t> to_;
  std::vector<std::size_t> positions_;  // by slice and digit
};

}  // namespace tact::base

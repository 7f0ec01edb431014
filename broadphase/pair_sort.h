// Sorts pairs of indices by (a, b).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "broadphase/index_pair.h"
#include "broadphase/pair_list.h"

namespace tact::broadphase {

class PairSorter {
 public:
  // The pairs of all `parts`, sorted. Indices are below `index_count`. The answer is valid until the next call. A radix
  // sort from the lowest digit up, stable, so that it needs no comparison.
  std::span<const IndexPair> sort(std::span<const PairList> parts, std::size_t index_count, int threads);

 private:
  struct Digit {
    std::uint32_t IndexPair::*field;
    int shift;
    int bits;
  };
  void pass(std::size_t count, Digit digit, int threads);

  std::vector<IndexPair> from_;
  std::vector<IndexPair> to_;
  std::vector<std::size_t> positions_;  // by digit value and slice
};

}  // namespace tact::broadphase

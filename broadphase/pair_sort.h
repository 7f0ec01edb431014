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
  void pass(std::size_t count, int shift, int bits, int threads);

  std::vector<std::uint64_t> from_;  // keys: a in the upper bits, b in the lower ones
  std::vector<std::uint64_t> to_;
  std::vector<std::size_t> positions_;  // by slice and digit
  std::vector<IndexPair> pairs_;
};

}  // namespace tact::broadphase

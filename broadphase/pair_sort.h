// Sorts pairs of indices by (a, b).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "broadphase/index_pair.h"
#include "broadphase/pair_list.h"
#include "engine/base/key_sort.h"

namespace tact::broadphase {

class PairSorter {
 public:
  // The pairs of all `parts`, sorted. Indices are below `index_count`. The answer is valid until the next call.
  std::span<const IndexPair> sort(std::span<const PairList> parts, std::size_t index_count, int threads);

 private:
  base::KeySorter sorter_;  // of keys with a in the upper bits, b in the lower ones
  std::vector<IndexPair> pairs_;
};

}  // namespace tact::broadphase

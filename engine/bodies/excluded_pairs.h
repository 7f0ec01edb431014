// Pairs of bodies that a caller does not want tested: those of a joint, say.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "broadphase/sweep_and_prune.h"

namespace tact {

// Pairs are of slots, the smaller one first.
class ExcludedPairs {
  friend struct StateFields;

 public:
  bool empty() const { return pairs_.empty(); }
  bool contains(const broadphase::IndexPair& pair) const { return std::ranges::binary_search(pairs_, pair); }
  // Whether other pairs were excluded before end_step().
  bool changed() const { return changed_; }

  // A pair that is not there yet.
  void add(const broadphase::IndexPair& pair) {
    pairs_.insert(std::ranges::upper_bound(pairs_, pair), pair);
    changed_ = true;
  }
  // A pair that is there.
  void remove(const broadphase::IndexPair& pair) {
    pairs_.erase(std::ranges::lower_bound(pairs_, pair));
    changed_ = true;
  }
  // All pairs of a body that goes.
  void remove_all_of(std::uint32_t slot) {
    std::erase_if(pairs_, [&](const broadphase::IndexPair& pair) { return pair.a == slot || pair.b == slot; });
  }
  void end_step() { changed_ = false; }

 private:
  std::vector<broadphase::IndexPair> pairs_;  // sorted
  bool changed_ = false;
};

}  // namespace tact

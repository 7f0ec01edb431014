// Which boxes overlap: sweep and prune, carried from step to step.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/box.h"

namespace tact::broadphase {

using base::Box;

// What decides, besides boxes, whether two bodies are tested.
struct Filter {
  std::uint32_t layer = 1;  // a pair is tested if each mask holds a bit of the other's layer,
  std::uint32_t mask = 0xffffffffu;
  bool fixed = false;  // and not both are fixed
};

// Indices of two boxes, a < b.
struct IndexPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  friend constexpr auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

class SweepAndPrune {
 public:
  // Finds all pairs of `boxes` that overlap (closed: touching counts) and whose filters agree, sorted by (a, b). An
  // empty box overlaps nothing. `changed` lists, in any order, every index whose box or filter differs from the last
  // call, those beyond the last call's size included. The answer is valid until the next call and depends on the boxes
  // and filters alone: not on history, nor on `threads`.
  std::span<const IndexPair> update(std::span<const Box> boxes, std::span<const Filter> filters,
                                    std::span<const std::uint32_t> changed, int threads);

  std::span<const IndexPair> pairs() const { return pairs_; }

 private:
  std::size_t size_ = 0;
  std::vector<std::uint32_t> order_;
  std::vector<IndexPair> pairs_;
};

}  // namespace tact::broadphase

// Which facets of two blocks meet: by what can be told of many pairs at once, then by exact predicates.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/predicates.h"

namespace tact::narrowphase {

struct ConfirmCounts {
  std::int64_t facet_box_pairs = 0;
  std::int64_t triangle_tests = 0;
  PredicateCounts predicates;
};

// A grid over a box, which ends where cell `last` begins.
Grid grid_over(const BoxBounds& box, double last);

class BlockPair {
 public:
  // Facets of `a` and `b`, a bit each, which lie in the box `bounds`. Their cells are those of `grid`, into the box of
  // which each facet's reaches: so boxes that share cells are less than a cell apart.
  void begin(const FacetBlock& a, std::uint64_t of_a, const FacetBlock& b, std::uint64_t of_b, const BoxBounds& bounds,
             const Grid& grid);

  // A bit for each pair of these facets that meet. The boxes of each pair share cells.
  std::uint64_t meeting(const FacetPairList& pairs, ConfirmCounts& counts);

 private:
  void prepare(int pairs);
  PairMatches matches_of(const FacetPairList& pairs) const;

  const FacetBlock* a_ = nullptr;
  const FacetBlock* b_ = nullptr;
  std::uint64_t of_a_ = 0, of_b_ = 0;
  BoxBounds bounds_ = {};
  Grid grid_ = {};
  bool prepared_ = false;    // then:
  bool on_lattice_ = false;  // nothing is rounded
  bool in_floats_ = false;   // the corners are here
  FloatCorners floats_a_, floats_b_;
  double gap_[3] = {};  // a cell, in their grid
};

}  // namespace tact::narrowphase

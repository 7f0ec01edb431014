// Which facets of two blocks meet: by what can be told of many pairs at once, then by exact predicates.
#pragma once

#include <tact/facet_pair.h>

#include <cstdint>
#include <vector>

#include "engine/base/tuning.h"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

struct ConfirmCounts {
  std::int64_t facet_box_pairs = 0;
  std::int64_t triangle_tests = 0;
  std::int64_t still_apart = 0;  // cluster pairs that SurfaceHistory knew to be apart
  std::int64_t plane_apart = 0;  // and that a plane along a surface separates: see surface_pairs.h
  std::int64_t left_open = 0;    // facet pairs that floats left open there
  PredicateCounts predicates;

  ConfirmCounts& operator+=(const ConfirmCounts& other) {
    facet_box_pairs += other.facet_box_pairs;
    triangle_tests += other.triangle_tests;
    still_apart += other.still_apart;
    plane_apart += other.plane_apart;
    left_open += other.left_open;
    predicates.exact += other.predicates.exact;
    return *this;
  }
};

// A grid over a box, which ends where cell `last` begins.
Grid grid_over(const BoxBounds& box, double last);

// The cells of a grid with kLastCell that a box reaches.
CellBox cells_of(const Grid& grid, const BoxBounds& box);

class BlockPair {
 public:
  // Appends the pairs of facets that meet, facets of `a` and `b` that have a bit, by their places in the blocks. These
  // facets lie in the box `bounds`. Their cells are those of `grid`, into the box of which each facet's reaches: so
  // boxes that share cells are less than a cell apart. `excluded`: of each facet of `a` those of `b` that are left out;
  // null: none.
  void find_meeting(const FacetBlock& a, std::uint64_t of_a, const FacetBlock& b, std::uint64_t of_b,
                    const BoxBounds& bounds, const Grid& grid, const base::Tuning& tuning,
                    std::vector<FacetPair>& found, ConfirmCounts& counts, const std::uint64_t* excluded = nullptr);

  // A bit for each of the listed pairs that meets, all of them in the box `bounds`: in doubles, then exactly.
  std::uint64_t meeting_of(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                           const BoxBounds& bounds, ConfirmCounts& counts);

 private:
  SharedCells share_cells(const FacetBlock& a, std::uint64_t of_a, const FacetBlock& b, std::uint64_t of_b,
                          const std::uint64_t* excluded);
  Grid choose_digits(bool floats_are_worth_it);
  std::uint64_t meeting_of_listed(ConfirmCounts& counts) const;
  PairMatches matches_of_listed() const;

  const FacetBlock* a_ = nullptr;
  const FacetBlock* b_ = nullptr;
  bool decides_many_ = true;
  BoxBounds bounds_ = {};
  std::uint64_t met_[FacetBlock::kCapacity];  // of each facet of the one block, those of the other that it may meet
  FacetPairList pairs_;                       // some of these, to be decided together
  bool exact_ = false;                        // nothing is rounded
  bool in_floats_ = false;                    // the corners are here
  FloatCorners floats_a_, floats_b_;
  double gap_[3] = {};  // a cell, in their grid
};

}  // namespace tact::narrowphase

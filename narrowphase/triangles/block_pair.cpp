#include "narrowphase/triangles/block_pair.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "narrowphase/triangles/lattice.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

std::int16_t cell(const Grid& grid, int axis, double x) {
  return static_cast<std::int16_t>(std::clamp((x - grid.origin[axis]) * grid.scale[axis], 0.0, kLastCell));
}

Triangle triangle_in(const FacetBlock& block, std::size_t i) {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = {block.corner[k][0][i], block.corner[k][1][i], block.corner[k][2][i]};
  return t;
}

}  // namespace

Grid grid_over(const BoxBounds& box, double last) {
  Grid grid;
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = box.lower[axis];
    grid.scale[axis] = std::min(last / (box.upper[axis] - box.lower[axis]), 0x1p1000);  // also of a flat box
  }
  return grid;
}

CellBox cells_of(const Grid& grid, const BoxBounds& box) {
  CellBox cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lower[axis] = cell(grid, axis, box.lower[axis]);
    cells.upper[axis] = cell(grid, axis, box.upper[axis]);
  }
  return cells;
}

// By the cells of their boxes, by the planes of the fewer facets, then many pairs at a time.
void BlockPair::find_meeting(const FacetBlock& a, std::uint64_t of_a, const FacetBlock& b, std::uint64_t of_b,
                             const BoxBounds& bounds, const Grid& grid, const base::Tuning& tuning,
                             std::vector<FacetPair>& found, ConfirmCounts& counts, const std::uint64_t* excluded) {
  const bool few_are_b = excluded == nullptr && std::popcount(of_b) < std::popcount(of_a);
  const SharedCells shared =
      few_are_b ? share_cells(b, of_b, a, of_a, nullptr) : share_cells(a, of_a, b, of_b, excluded);
  counts.facet_box_pairs += shared.pairs;
  if (shared.pairs == 0) return;
  a_ = &a;
  b_ = &b;
  decides_many_ = tuning.decides_many;
  bounds_ = bounds;
  const Grid unit = choose_digits(static_cast<std::size_t>(shared.pairs) >= tuning.worth_floats);
  if (in_floats_) {
    kernels().float_corners(a, of_a, unit, &floats_a_);
    kernels().float_corners(b, of_b, unit, &floats_b_);
    for (int axis = 0; axis < 3; ++axis) gap_[axis] = unit.scale[axis] / grid.scale[axis];
  }
  if (in_floats_ && !exact_) {
    const FloatCorners &few = few_are_b ? floats_b_ : floats_a_, &many = few_are_b ? floats_a_ : floats_b_;
    kernels().leave_aside(few, shared.facets, many, gap_, 0.0f, static_cast<int>(tuning.worth_a_plane), met_);
  }
  for (std::uint64_t left = shared.facets; left != 0;) {
    pairs_.count = 0;
    left = kernels().list_pairs(left, met_, few_are_b, &pairs_);
    if (pairs_.count == 0) return;
    for (std::uint64_t meeting = meeting_of_listed(counts); meeting != 0; meeting &= meeting - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(meeting));
      found.push_back({pairs_.a[k], pairs_.b[k]});
    }
  }
}

SharedCells BlockPair::share_cells(const FacetBlock& a, std::uint64_t of_a, const FacetBlock& b, std::uint64_t of_b,
                                   const std::uint64_t* excluded) {
  SharedCells shared = kernels().share_cells(a.cells, of_a, b.cells, of_b, met_);
  if (excluded == nullptr) return shared;
  // How many pairs are left is not worth counting: as many as facets with a pair, at least.
  for (std::uint64_t left = std::exchange(shared, {}).facets; left != 0; left &= left - 1) {
    const int f = std::countr_zero(left);
    met_[f] &= ~excluded[f];
    shared.pairs += met_[f] != 0 ? 1 : 0;
    shared.facets |= static_cast<std::uint64_t>(met_[f] != 0) << f;
  }
  return shared;
}

std::uint64_t BlockPair::meeting_of(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                                    const BoxBounds& bounds, ConfirmCounts& counts) {
  a_ = &a;
  b_ = &b;
  bounds_ = bounds;
  pairs_ = pairs;
  choose_digits(false);
  return meeting_of_listed(counts);
}

// What pairs are decided in, and the grid in which floats are made of their corners.
Grid BlockPair::choose_digits(bool floats_are_worth_it) {
  const auto on = [&](const Lattice& lattice) {
    return lattice.step > 0.0 && kernels().on_lattice(*a_, lattice.step) && kernels().on_lattice(*b_, lattice.step);
  };
  in_floats_ = floats_are_worth_it;
  exact_ = on(finest_lattice_in_doubles(bounds_));
  if (exact_ && in_floats_) {  // that for floats is coarser
    const Lattice lattice = finest_lattice_in_floats(bounds_);
    in_floats_ = on(lattice);
    if (in_floats_) return lattice.grid;
  }
  return grid_over(bounds_, 1.0);
}

// What can be told of many pairs at once: all if nothing is rounded; else in floats, of those that these leave open in
// doubles, then by equal corners, then within a common plane or in double-double.
PairMatches BlockPair::matches_of_listed() const {
  const FacetBlock &a = *a_, &b = *b_;
  PairMatches all;
  all.undecided = ~std::uint64_t{0} >> (FacetPairList::kCapacity - pairs_.count);
  if (!decides_many_) return all;
  if (exact_) {
    return in_floats_ ? kernels().match_exact_float_pairs(floats_a_, floats_b_, pairs_)
                      : kernels().match_exact_pairs(a, b, pairs_);
  }
  const PairMatches floats = in_floats_ ? kernels().match_float_pairs(floats_a_, floats_b_, pairs_, gap_) : all;
  if (floats.undecided == 0) return floats;
  const PairMatches doubles = kernels().match_pairs(a, b, pairs_, floats.undecided, bounds_);
  const std::uint64_t meeting = floats.meeting | doubles.meeting;
  if (doubles.undecided == 0) return {.meeting = meeting};
  const std::uint64_t sharing = kernels().sharing_pairs(a, b, pairs_, doubles.undecided);
  const std::uint64_t flat = doubles.flat & ~sharing;
  const PairMatches wide = kernels().match_pairs_wide(a, b, pairs_, doubles.undecided & ~(sharing | flat));
  const std::uint64_t in_plane = flat | (wide.undecided & wide.flat);
  const PairMatches plane = kernels().match_flat_pairs(a, b, pairs_, in_plane);
  return {.meeting = meeting | sharing | wide.meeting | plane.meeting,
          .undecided = (wide.undecided & ~in_plane) | plane.undecided,
          .flat = plane.undecided};
}

// A bit for each listed pair that meets: what is left open, exact predicates decide.
std::uint64_t BlockPair::meeting_of_listed(ConfirmCounts& counts) const {
  const PairMatches matches = matches_of_listed();
  std::uint64_t meeting = matches.meeting;
  for (std::uint64_t left = matches.undecided; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    ++counts.triangle_tests;
    const Triangle p = triangle_in(*a_, static_cast<std::size_t>(pairs_.a[k]));
    const Triangle q = triangle_in(*b_, static_cast<std::size_t>(pairs_.b[k]));
    const bool is_flat = (matches.flat >> k & 1) != 0;
    if (is_flat ? coplanar_triangles_meet(p, q, counts.predicates) : triangle_triangle_meet(p, q, counts.predicates)) {
      meeting |= std::uint64_t{1} << k;
    }
  }
  return meeting;
}

}  // namespace tact::narrowphase

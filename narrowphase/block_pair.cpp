#include "narrowphase/block_pair.h"

#include <algorithm>
#include <bit>

#include "engine/base/fast_paths.h"
#include "narrowphase/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

// From so many pairs on it is worth making floats of all corners of two blocks.
constexpr int kWorthFloats = 32;

using base::fast_paths;
using base::FastPaths;

bool worth_floats(int pairs) {
  if (fast_paths() == FastPaths::automatic) return pairs >= kWorthFloats;
  return fast_paths() == FastPaths::always;
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

void BlockPair::begin(const FacetBlock& a, std::uint64_t of_a, const FacetBlock& b, std::uint64_t of_b,
                      const BoxBounds& bounds, const Grid& grid) {
  a_ = &a;
  b_ = &b;
  of_a_ = of_a;
  of_b_ = of_b;
  bounds_ = bounds;
  grid_ = grid;
  prepared_ = false;
}

void BlockPair::prepare(int pairs) {
  prepared_ = true;
  on_lattice_ = kernels().on_lattice(*a_, bounds_) && kernels().on_lattice(*b_, bounds_);
  in_floats_ = !on_lattice_ && worth_floats(pairs);
  if (!in_floats_) return;
  const Grid unit = grid_over(bounds_, 1.0);
  kernels().float_corners(*a_, of_a_, unit, &floats_a_);
  kernels().float_corners(*b_, of_b_, unit, &floats_b_);
  for (int axis = 0; axis < 3; ++axis) gap_[axis] = unit.scale[axis] / grid_.scale[axis];
}

// What can be told of many pairs at once: in floats; of those that these leave open in doubles, then by equal corners,
// then within a common plane or with twice the digits.
PairMatches BlockPair::matches_of(const FacetPairList& pairs) const {
  const FacetBlock &a = *a_, &b = *b_;
  PairMatches all;
  all.undecided = ~std::uint64_t{0} >> (FacetPairList::kCapacity - pairs.count);
  if (fast_paths() == FastPaths::off) return all;
  const PairMatches floats = in_floats_ ? kernels().match_float_pairs(floats_a_, floats_b_, pairs, gap_) : all;
  if (floats.undecided == 0) return floats;
  const PairMatches doubles = kernels().match_pairs(a, b, pairs, floats.undecided, bounds_, on_lattice_);
  const std::uint64_t meeting = floats.meeting | doubles.meeting;
  if (doubles.undecided == 0) return {.meeting = meeting};
  const std::uint64_t sharing = on_lattice_ ? 0 : kernels().sharing_pairs(a, b, pairs, doubles.undecided);
  const std::uint64_t flat = doubles.flat & ~sharing;
  const PairMatches wide = kernels().match_pairs_wide(a, b, pairs, doubles.undecided & ~(sharing | flat));
  const std::uint64_t in_plane = flat | (wide.undecided & wide.flat);
  const PairMatches plane = kernels().match_flat_pairs(a, b, pairs, in_plane, on_lattice_);
  return {.meeting = meeting | sharing | wide.meeting | plane.meeting,
          .undecided = (wide.undecided & ~in_plane) | plane.undecided,
          .flat = plane.undecided};
}

std::uint64_t BlockPair::meeting(const FacetPairList& pairs, ConfirmCounts& counts) {
  if (pairs.count == 0) return 0;
  if (!prepared_) prepare(pairs.count);
  const PairMatches matches = matches_of(pairs);
  std::uint64_t meeting = matches.meeting;
  for (std::uint64_t left = matches.undecided; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    ++counts.triangle_tests;
    const Triangle p = triangle_in(*a_, static_cast<std::size_t>(pairs.a[k]));
    const Triangle q = triangle_in(*b_, static_cast<std::size_t>(pairs.b[k]));
    const bool is_flat = (matches.flat >> k & 1) != 0;
    if (is_flat ? coplanar_triangles_meet(p, q, counts.predicates) : triangle_triangle_meet(p, q, counts.predicates)) {
      meeting |= std::uint64_t{1} << k;
    }
  }
  return meeting;
}

}  // namespace tact::narrowphase

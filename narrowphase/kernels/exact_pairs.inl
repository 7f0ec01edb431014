// Which of many pairs of facets meet where no determinant is rounded: corners on a lattice (see
// narrowphase/triangles/lattice.h), in doubles or, where they are enough, in floats.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/clear_pairs.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/pair_lanes.inl"

namespace tact::narrowphase {
namespace {

bool on_lattice(const FacetBlock& block, double step) {
  // Adding 3/2 * 2^52 steps, which leaves no room for parts of one, and taking them away again.
  const Pack whole = spread(0x1.8p52 * step);
  for (int i = 0; i < block.count; i += kWidth) {
    for (int k = 0; k < 3; ++k) {
      unsigned off = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Pack x = load(block.corner[k][axis] + i);
        off |= bits(not_equal(sub(add(x, whole), whole), x));
      }
      if ((off & lanes_left(block.count - i)) != 0) return false;
    }
  }
  return true;
}

// The policy for signs where nothing is rounded.
template <class Number>
struct ExactSigns {
  using Real = Number;
  static constexpr bool kTrustsZero = true;

  PlaneSides<Real> sides(const VectorOf<Real>* plane, const VectorOf<Real>* corner) const {
    const ClearPlane<Real> of(plane[0], plane[1], plane[2]);
    const PackOf<Real> zero = spread(Real{0});
    PlaneSides<Real> sides;
    MaskOf<Real> not_below[3];
    for (int k = 0; k < 3; ++k) {
      const PackOf<Real> height = of.height(corner[k]);
      sides.above[k] = less(zero, height);
      not_below[k] = less_equal(zero, height);
    }
    const auto any_above = any_of(sides.above);
    sides.apart = bits(all_of(sides.above)) | ~bits(any_of(not_below));
    sides.flat = bits(without(all_of(not_below), any_above));
    sides.strict = sides.known = ~0u;
    for (int k = 0; k < 3; ++k) sides.above[k] = either(sides.above[k], without(not_below[k], any_above));
    return sides;
  }
  PiecesMeet pieces(const CommonLine<Real>& line) const {
    const PackOf<Real> zero = spread(Real{0});
    const unsigned meet = bits(both(less_equal(zero, line.p()), less_equal(line.q(), zero)));
    return {meet, ~meet, 0};
  }
};

// Lanes in which a side of `t`, which turns to the left where `left` is set, has all of `other` strictly beyond it.
template <class Real>
inline MaskOf<Real> has_side_before(const PointPack<Real>* t, MaskOf<Real> left, const PointPack<Real>* other) {
  MaskOf<Real> beyond_any = differ(left, left);
  for (int i = 0; i < 3; ++i) {
    const PointPack<Real> from = t[i], to = t[(i + 1) % 3];
    MaskOf<Real> right[3], wrong[3];
    for (int k = 0; k < 3; ++k) {
      const PackOf<Real> one = mul(sub(to.x, from.x), sub(other[k].y, from.y));
      const PackOf<Real> two = mul(sub(to.y, from.y), sub(other[k].x, from.x));
      right[k] = less(one, two);
      wrong[k] = less(two, one);
    }
    const auto all_right = both(both(right[0], right[1]), right[2]),
               all_wrong = both(both(wrong[0], wrong[1]), wrong[2]);
    beyond_any = either(beyond_any, either(both(left, all_right), without(all_wrong, left)));
  }
  return beyond_any;
}

// Triangles of one plane are apart if and only if a side of one has the other beyond it. Those without area are left
// open.
template <class Real>
inline Meeting match_exact_flat_lanes(const VectorOf<Real>* a, const VectorOf<Real>* b, unsigned mask) {
  const ClearPlane<Real> plane_a(a[0], a[1], a[2]), plane_b(b[0], b[1], b[2]);
  const Projection<Real> project(plane_b.normal);
  const PackOf<Real> turn_a = project.component(plane_a.normal), turn_b = project.component(plane_b.normal);
  const PackOf<Real> zero = spread(Real{0});
  const unsigned known = mask & bits(both(less(zero, abs(turn_a)), less(zero, abs(turn_b))));
  const PointPack<Real> p[3] = {project(a[0]), project(a[1]), project(a[2])};
  const PointPack<Real> q[3] = {project(b[0]), project(b[1]), project(b[2])};
  const unsigned apart =
      bits(either(has_side_before<Real>(q, less(zero, turn_b), p), has_side_before<Real>(p, less(zero, turn_a), q)));
  return {known & ~apart, known & apart, mask};
}

template <class Block>
inline PairMatches match_exactly(const Block& a, const Block& b, const FacetPairList& pairs) {
  using Corner = const VectorOf<RealIn<Block>>*;
  const auto decide = [](Corner p, Corner q, unsigned lanes) {
    return match_lanes(ExactSigns<RealIn<Block>>{}, p, q, lanes);
  };
  const auto decide_flat = [](Corner p, Corner q, unsigned lanes) { return match_exact_flat_lanes(p, q, lanes); };
  const std::uint64_t all = ~std::uint64_t{0} >> (FacetPairList::kCapacity - pairs.count);
  PairMatches matches = match_some(a, b, pairs, all, decide);
  if (matches.flat == 0) return matches;
  const PairMatches in_plane = match_some(a, b, pairs, matches.flat, decide_flat);
  matches.meeting |= in_plane.meeting;
  matches.undecided = (matches.undecided & ~matches.flat) | in_plane.undecided;
  matches.flat = in_plane.undecided;
  return matches;
}

PairMatches match_exact_pairs(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs) {
  return match_exactly(a, b, pairs);
}

PairMatches match_exact_float_pairs(const FloatCorners& a, const FloatCorners& b, const FacetPairList& pairs) {
  return match_exactly(a, b, pairs);
}

}  // namespace
}  // namespace tact::narrowphase

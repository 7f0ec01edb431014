// Which of many pairs of facets meet where no determinant is near zero: in floats, which take half
// the time and leave few open, and in doubles.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/pair_lanes.inl"

namespace tact::narrowphase {
namespace {

template <class Real>
inline PackOf<Real> opposite(PackOf<Real> x) {
  return sub(spread(Real{0}), x);
}

// The policy for signs where every determinant is off by `error` at most: nothing is known of one that is nearer to
// zero.
template <class Number>
struct LooseSigns {
  using Real = Number;
  static constexpr bool kTrustsZero = true;  // it is never asked

  PackOf<Real> error, opposite_error;

  explicit LooseSigns(PackOf<Real> off_by) : error(off_by), opposite_error(opposite<Real>(off_by)) {}

  PlaneSides<Real> sides(const ClearPlane<Real>& plane, const VectorOf<Real>* corner) const {
    PlaneSides<Real> sides;
    MaskOf<Real> below[3];
    for (int k = 0; k < 3; ++k) {
      const PackOf<Real> height = plane.height(corner[k]);
      sides.above[k] = less(error, height);
      below[k] = less(height, opposite_error);
    }
    sides.apart = bits(either(all_of(sides.above), all_of(below)));
    sides.strict = bits(both(both(either(sides.above[0], below[0]), either(sides.above[1], below[1])),
                             either(sides.above[2], below[2])));
    sides.known = sides.strict;
    sides.flat = 0;
    return sides;
  }
  PlaneSides<Real> sides(const VectorOf<Real>* plane, const VectorOf<Real>* corner) const {
    return sides(ClearPlane<Real>(plane[0], plane[1], plane[2]), corner);
  }
  PiecesMeet pieces(const CommonLine<Real>& line) const {
    const PackOf<Real> p = line.p(), q = line.q();
    return {bits(both(less(error, p), less(q, opposite_error))), bits(either(less(p, opposite_error), less(error, q))),
            0};
  }
};

// Scaling the axes does not change the sign of a determinant, so two facets are tested by their corners in a
// grid of one cell, between 0 and 1 along each axis.
void float_corners(const FacetBlock& block, std::uint64_t facets, const Grid& grid, FloatCorners* corners) {
  Pack extent[3] = {spread(0.0), spread(0.0), spread(0.0)};
  corners->count = block.count;
  corners->error = 1.001 * 0x1p-24;
  for (std::uint64_t left = facets; left != 0;) {
    const int i = __builtin_ctzll(left) / kWidth * kWidth;
    const Mask lanes = mask_of(static_cast<unsigned>(left >> i) & kAllLanes);
    left &= ~(static_cast<std::uint64_t>(kAllLanes) << i);
    for (int axis = 0; axis < 3; ++axis) {
      Pack x[3];
      for (int k = 0; k < 3; ++k) {
        x[k] = load(block.corner[k][axis] + i);
        store(corners->corner[k][axis] + i, place_in(grid, axis, x[k]));
      }
      const Pack one = sub(max(max(x[0], x[1]), x[2]), min(min(x[0], x[1]), x[2]));
      extent[axis] = max(extent[axis], select(lanes, one, spread(0.0)));
    }
  }
  for (int axis = 0; axis < 3; ++axis) corners->extent[axis] = largest_lane(extent[axis]) * grid.scale[axis];
}

// Bounds the rounding of every determinant of a pair of facets whose boxes are at most `gap` apart along each axis.
// With u = 2^-24: coordinates are off by at most e; differences, which are up to m, the extents of two facets and the
// gap, by 2 e + 1.001 (m + 2 e) u, so up to m' = 1.0001 (m + 2 e) as computed; each of the six products of three is
// rounded five times, sums included. So with S = m'x m'y + m'y m'z + m'z m'x a determinant is off by at most 6 * 2 e S
// + 6 * (3.003 + 5.001) u m'x m'y m'z, and by what products lose that vanish.
inline float float_rounding(const FloatCorners& a, const FloatCorners& b, const double* gap) {
  const double error = a.error > b.error ? a.error : b.error;
  double m[3];
  for (int axis = 0; axis < 3; ++axis) {
    m[axis] = 1.0001 * (a.extent[axis] + b.extent[axis] + gap[axis] + 2.0 * error);
  }
  const double sides = m[0] * m[1] + m[1] * m[2] + m[2] * m[0], product = m[0] * m[1] * m[2];
  return static_cast<float>(12.1 * error * sides + 0x1p-24 * 48.2 * product + 1e-30);
}

void leave_aside(const FloatCorners& few, std::uint64_t some, const FloatCorners& many, const double* gap, float slack,
                 int plane_from, std::uint64_t* met) {
  const FloatPack rounding = spread(float_rounding(few, many, gap));
  for (; some != 0; some &= some - 1) {
    const int f = __builtin_ctzll(some);
    if (__builtin_popcountll(met[f]) < plane_from) continue;
    VectorOf<float> of_f[3];
    for (int k = 0; k < 3; ++k) {
      of_f[k] = {spread(few.corner[k][0][f]), spread(few.corner[k][1][f]), spread(few.corner[k][2][f])};
    }
    const ClearPlane<float> plane(of_f[0], of_f[1], of_f[2]);
    const FloatPack length = add(add(abs(plane.normal.x), abs(plane.normal.y)), abs(plane.normal.z));  // or more
    const LooseSigns<float> signs(add(rounding, mul(spread(slack), length)));
    for (std::uint64_t left = met[f]; left != 0;) {
      const int i = __builtin_ctzll(left) / kFloatWidth * kFloatWidth;
      VectorOf<float> corner[3];
      for (int k = 0; k < 3; ++k) {
        corner[k] = {load(many.corner[k][0] + i), load(many.corner[k][1] + i), load(many.corner[k][2] + i)};
      }
      met[f] &= ~(static_cast<std::uint64_t>(signs.sides(plane, corner).apart) << i);
      left &= ~(static_cast<std::uint64_t>(kAllFloatLanes) << i);
    }
  }
}

// If the float filter leaves more than half undecided, later blocks skip it.
PairMatches match_float_pairs(const FloatCorners& a, const FloatCorners& b, const FacetPairList& pairs,
                              const double* gap) {
  const LooseSigns<float> signs(spread(float_rounding(a, b, gap)));
  std::uint64_t yes = 0, no = 0;
  for (int i = 0; i < pairs.count; i += kFloatWidth) {
    VectorOf<float> corner_a[3], corner_b[3];
    gather_corners(a, pairs.a + i, corner_a);
    gather_corners(b, pairs.b + i, corner_b);
    const Meeting meeting = match_lanes(signs, corner_a, corner_b, lanes_left<kFloatWidth>(pairs.count - i));
    yes |= static_cast<std::uint64_t>(meeting.yes) << i;
    no |= static_cast<std::uint64_t>(meeting.no) << i;
    const int seen = i + kFloatWidth;
    if (seen % 16 == 0 && 2 * __builtin_popcountll(yes | no) < seen) break;
  }
  PairMatches matches;
  matches.meeting = yes;
  matches.undecided =
      (pairs.count == 0 ? 0 : ~std::uint64_t{0} >> (FacetPairList::kCapacity - pairs.count)) & ~(yes | no);
  return matches;
}

}  // namespace
}  // namespace tact::narrowphase

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

// On which side of a plane the corners of a triangle lie, by their heights over it.
template <class Real>
struct ClearSides {
  MaskOf<Real> above[3];
  unsigned apart, certain;  // bits: all three on one side; all three farther away than rounding

  ClearSides(const ClearPlane<Real>& plane, const VectorOf<Real>* corner, PackOf<Real> error) {
    const PackOf<Real> opposite_error = opposite<Real>(error);
    MaskOf<Real> below[3];
    for (int k = 0; k < 3; ++k) {
      const PackOf<Real> height = plane.height(corner[k]);
      above[k] = less(error, height);
      below[k] = less(height, opposite_error);
    }
    const auto all_above = both(both(above[0], above[1]), above[2]), all_below = both(both(below[0], below[1]), below[2]);
    apart = bits(either(all_above, all_below));
    certain = bits(both(both(either(above[0], below[0]), either(above[1], below[1])), either(above[2], below[2])));
  }
};

// What match_lanes says, where all determinants are farther from zero than `error`, which bounds the rounding of each;
// nothing of other lanes.
template <class Real>
inline Meeting match_clear_lanes(const VectorOf<Real>* a, const VectorOf<Real>* b, unsigned mask,
                                 PackOf<Real> error) {
  const ClearSides<Real> sides_b({a[0], a[1], a[2]}, b, error);
  unsigned left = mask & ~sides_b.apart;
  if (left == 0) return {0, mask, 0};
  const ClearSides<Real> sides_a({b[0], b[1], b[2]}, a, error);
  left &= ~sides_a.apart;
  const unsigned certain = left & sides_a.certain & sides_b.certain;
  if (certain == 0) return {0, mask & ~left, 0};
  const CommonLine<Real> line(lone_corner<Real>(a, sides_a.above), lone_corner<Real>(b, sides_b.above));
  const PackOf<Real> p = line.p(), q = line.q();
  const PackOf<Real> opposite_error = opposite<Real>(error);
  const unsigned yes = bits(both(less(error, p), less(q, opposite_error)));
  const unsigned no = bits(either(less(p, opposite_error), less(error, q)));
  return {yes & certain, (mask & ~left) | (no & certain), 0};
}

// Scaling the axes does not change the sign of a determinant, so where two facets meet is asked of their corners in a
// grid of one cell, between 0 and 1 along each axis.
void float_corners(const FacetBlock& block, std::uint64_t facets, const Grid& grid, FloatCorners* corners) {
  Pack extent[3] = {spread(0.0), spread(0.0), spread(0.0)};
  corners->count = block.count;
  for (std::uint64_t left = facets; left != 0;) {
    const int i = __builtin_ctzll(left) / kWidth * kWidth;
    const Mask lanes = mask_of(static_cast<unsigned>(left >> i) & kAllLanes);
    left &= ~(static_cast<std::uint64_t>(kAllLanes) << i);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 3; ++k) {
        store(corners->corner[k][axis] + i, place_in(grid, axis, load(block.corner[k][axis] + i)));
      }
      const Pack one = sub(load(block.upper[axis] + i), load(block.lower[axis] + i));
      extent[axis] = max(extent[axis], select(lanes, one, spread(0.0)));
    }
  }
  for (int axis = 0; axis < 3; ++axis) corners->extent[axis] = largest_lane(extent[axis]) * grid.scale[axis];
}

// Bounds the rounding of every determinant of a pair of facets whose boxes are at most `gap` apart along each axis, all of
// it in units of the grid. With u = 2^-24: coordinates are off by at most 1.001 u; differences, which are up to
// m <= 1, the extents of two facets and the gap, by 2.003 u + 1.001 m u < 4 u, so up to m' = m + 4 u as computed; each of
// the six products of three is rounded five times, sums included. So with S = m'x m'y + m'y m'z + m'z m'x a determinant is
// off by at most 6 * 2.003 u S + 6 * (3.003 + 5.001) u m'x m'y m'z, and by what products lose that vanish.
inline float float_rounding(const FloatCorners& a, const FloatCorners& b, const double* gap) {
  double m[3];
  for (int axis = 0; axis < 3; ++axis) {
    m[axis] = a.extent[axis] + b.extent[axis] + gap[axis];
    if (!(m[axis] < 1.0)) m[axis] = 1.0;
    m[axis] = 1.0001 * (m[axis] + 0x1p-22);
  }
  const double sides = m[0] * m[1] + m[1] * m[2] + m[2] * m[0], product = m[0] * m[1] * m[2];
  return static_cast<float>(0x1p-24 * (12.1 * sides + 48.2 * product) + 1e-30);
}

void leave_aside(const FloatCorners& few, std::uint64_t some, const FloatCorners& many, const double* gap,
                 int plane_from, std::uint64_t* met) {
  const FloatPack error = spread(float_rounding(few, many, gap));
  for (; some != 0; some &= some - 1) {
    const int f = __builtin_ctzll(some);
    if (__builtin_popcountll(met[f]) < plane_from) continue;
    VectorOf<float> of_f[3];
    for (int k = 0; k < 3; ++k) {
      of_f[k] = {spread(few.corner[k][0][f]), spread(few.corner[k][1][f]), spread(few.corner[k][2][f])};
    }
    const ClearPlane<float> plane(of_f[0], of_f[1], of_f[2]);
    for (std::uint64_t left = met[f]; left != 0;) {
      const int i = __builtin_ctzll(left) / kFloatWidth * kFloatWidth;
      VectorOf<float> corner[3];
      for (int k = 0; k < 3; ++k) {
        corner[k] = {load(many.corner[k][0] + i), load(many.corner[k][1] + i), load(many.corner[k][2] + i)};
      }
      met[f] &= ~(static_cast<std::uint64_t>(ClearSides<float>(plane, corner, error).apart) << i);
      left &= ~(static_cast<std::uint64_t>(kAllFloatLanes) << i);
    }
  }
}

// Where floats leave half of the pairs open, they are asked no more.
PairMatches match_float_pairs(const FloatCorners& a, const FloatCorners& b, const FacetPairList& pairs,
                              const double* gap) {
  const FloatPack error = spread(float_rounding(a, b, gap));
  std::uint64_t yes = 0, no = 0;
  for (int i = 0; i < pairs.count; i += kFloatWidth) {
    VectorOf<float> corner_a[3], corner_b[3];
    gather_corners(a, pairs.a + i, corner_a);
    gather_corners(b, pairs.b + i, corner_b);
    const Meeting meeting = match_clear_lanes(corner_a, corner_b, lanes_left<kFloatWidth>(pairs.count - i), error);
    yes |= static_cast<std::uint64_t>(meeting.yes) << i;
    no |= static_cast<std::uint64_t>(meeting.no) << i;
    const int seen = i + kFloatWidth;
    if (seen % 16 == 0 && 2 * __builtin_popcountll(yes | no) < seen) break;
  }
  PairMatches matches;
  matches.meeting = yes;
  matches.undecided = (pairs.count == 0 ? 0 : ~std::uint64_t{0} >> (FacetPairList::kCapacity - pairs.count)) & ~(yes | no);
  return matches;
}

}  // namespace
}  // namespace tact::narrowphase

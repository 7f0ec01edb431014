// Pairs of facets, a lane each: what the ways to decide them have in common.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

template <class Real>
inline VectorOf<Real> select(MaskOf<Real> mask, const VectorOf<Real>& yes, const VectorOf<Real>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

// A triangle with its corners turned so that the plane of the other parts the first from the other two, which it
// crosses both edges to. `above` tells on which side the first is.
template <class Real>
struct LoneCorner {
  VectorOf<Real> lone, next, last;
  MaskOf<Real> above;
};

// The corners must not be all on one side. Of three sides two are equal: the lone corner is on that which an odd number
// are on.
template <class Real>
inline LoneCorner<Real> lone_corner(const VectorOf<Real>* c, const MaskOf<Real>* above) {
  const MaskOf<Real> not_first = differ(above[1], above[2]), third = differ(above[0], above[2]);
  const auto turned = [&](int first) {
    return select(not_first, select(third, c[(first + 2) % 3], c[(first + 1) % 3]), c[first]);
  };
  return {turned(0), turned(1), turned(2), differ(above[0], not_first)};
}

// A determinant without a bound of its own: the height of `point` over the plane through three points, times the length
// of its normal.
template <class Real>
struct ClearPlane {
  VectorOf<Real> origin, normal;

  ClearPlane(const VectorOf<Real>& c0, const VectorOf<Real>& c1, const VectorOf<Real>& c2) : origin(c0) {
    const VectorOf<Real> e = sub(c1, c0), f = sub(c2, c0);
    normal = {sub(mul(e.y, f.z), mul(e.z, f.y)), sub(mul(e.z, f.x), mul(e.x, f.z)), sub(mul(e.x, f.y), mul(e.y, f.x))};
  }
  PackOf<Real> height(const VectorOf<Real>& point) const { return dot(normal, sub(point, origin)); }
};

// Each triangle crosses or touches the other's plane: their intervals on the common line overlap if and only if two
// orientations of an edge of each have the right signs (Guigue and Devillers, 2003). As in triangle_triangle.cpp, where
// above is a negative orientation: p is not below, q not above.
template <class Real>
struct CommonLine {
  VectorOf<Real> a1, a2, b1, b2, lone_a, lone_b;

  CommonLine(const LoneCorner<Real>& a, const LoneCorner<Real>& b)
      : a1(select(b.above, a.next, a.last)),
        a2(select(b.above, a.last, a.next)),
        b1(select(a.above, b.next, b.last)),
        b2(select(a.above, b.last, b.next)),
        lone_a(a.lone),
        lone_b(b.lone) {}

  PackOf<Real> p() const { return ClearPlane<Real>(b1, a1, lone_b).height(lone_a); }
  PackOf<Real> q() const { return ClearPlane<Real>(b2, a2, lone_b).height(lone_a); }
};

// Bits of lanes that are certain; of the others, those where `a` lies in the plane of `b`.
struct Meeting {
  unsigned yes, no, flat;
};

// On which side of a plane the corners of a triangle lie, as far as a policy for signs tells; bits of lanes.
template <class Real>
struct PlaneSides {
  MaskOf<Real> above[3];  // where some corners lie in the plane, these count as below if any lies above, else as above
  unsigned apart;         // all three strictly on one side
  unsigned strict;        // each strictly on a side
  unsigned known;         // each on a side or in the plane
  unsigned flat;          // all three in the plane
};

template <class AnyMask>
inline AnyMask all_of(const AnyMask (&masks)[3]) {
  return both(both(masks[0], masks[1]), masks[2]);
}
template <class AnyMask>
inline AnyMask any_of(const AnyMask (&masks)[3]) {
  return either(either(masks[0], masks[1]), masks[2]);
}

// Whether the pieces of the common line overlap: bits of lanes, and of those where that hangs on a determinant that is
// zero.
struct PiecesMeet {
  unsigned yes, no, by_zero;
};

// Whether triangles meet: by the sides of their planes, then by their pieces of the common line. A policy says what is
// known of the signs of determinants:
//   loose  each is off by the same, at most (clear_pairs.inl)
//   exact  nothing is rounded (exact_pairs.inl)
//   tight  each by a bound of its own (facet_pairs.inl)
//   wide   the same in double-double
// It has Real; sides(plane of three corners, corners) and pieces(common line); and kTrustsZero: a determinant that
// comes out as zero is. Otherwise trusts_zero(corners) tells the lanes in which it is.
template <class Signs>
inline Meeting match_lanes(const Signs& signs, const VectorOf<typename Signs::Real>* a,
                           const VectorOf<typename Signs::Real>* b, unsigned mask) {
  using Real = typename Signs::Real;
  const PlaneSides<Real> sides_b = signs.sides(a, b);
  unsigned left = mask & ~sides_b.apart;
  if (left == 0) return {0, mask, 0};
  const PlaneSides<Real> sides_a = signs.sides(b, a);
  left &= ~sides_a.apart;
  const unsigned known = left & sides_a.known & sides_b.known & ~(sides_a.flat | sides_b.flat);
  unsigned flat = left & sides_a.flat;
  if (known == 0 && (Signs::kTrustsZero || flat == 0)) return {0, mask & ~left, flat};
  PiecesMeet pieces =
      signs.pieces(CommonLine<Real>(lone_corner<Real>(a, sides_a.above), lone_corner<Real>(b, sides_b.above)));
  if constexpr (!Signs::kTrustsZero) {
    const unsigned in_plane = known & ~(sides_a.strict & sides_b.strict);
    const unsigned by_zero = in_plane | (known & pieces.by_zero) | flat;
    if (by_zero != 0) {
      const unsigned vanishing = by_zero & ~(signs.trusts_zero(a) & signs.trusts_zero(b));
      pieces.yes &= ~vanishing;
      pieces.no &= ~(vanishing & in_plane);
      flat &= ~vanishing;
    }
  }
  return {pieces.yes & known, (mask & ~left) | (pieces.no & known), flat};
}

// What corners are stored in, and how they are picked.
template <class Block>
struct CornersIn;
template <>
struct CornersIn<FacetBlock> {
  using Real = double;
  using PicksOf = Picks;
};
template <>
struct CornersIn<FloatCorners> {
  using Real = float;
  using PicksOf = FloatPicks;
};
template <class Block>
using RealIn = typename CornersIn<Block>::Real;

template <class Block>
inline void gather_corners(const Block& block, const std::uint8_t* facet, VectorOf<RealIn<Block>>* corner) {
  const typename CornersIn<Block>::PicksOf at(facet);
  for (int k = 0; k < 3; ++k) {
    corner[k] = {pick(block.corner[k][0], block.count, at), pick(block.corner[k][1], block.count, at),
                 pick(block.corner[k][2], block.count, at)};
  }
}

// Those of the pairs that have a bit in `which`, a pack at a time: by judge(corners of a, corners of b, lanes).
template <class Block, class Judge>
inline PairMatches match_some(const Block& a, const Block& b, const FacetPairList& pairs, std::uint64_t which,
                              const Judge& judge) {
  using Real = RealIn<Block>;
  constexpr int kLanes = Lanes<Real>::kCount;
  FacetPairList some;
  some.count = __builtin_popcountll(which);
  compress(which, pairs.a, some.a);
  compress(which, pairs.b, some.b);
  std::uint64_t yes = 0, no = 0, flat = 0;
  for (int i = 0; i < some.count; i += kLanes) {
    VectorOf<Real> corner_a[3], corner_b[3];
    gather_corners(a, some.a + i, corner_a);
    gather_corners(b, some.b + i, corner_b);
    const Meeting meeting = judge(corner_a, corner_b, lanes_left<kLanes>(some.count - i));
    yes |= static_cast<std::uint64_t>(meeting.yes) << i;
    no |= static_cast<std::uint64_t>(meeting.no) << i;
    flat |= static_cast<std::uint64_t>(meeting.flat) << i;
  }
  PairMatches matches;
  matches.meeting = expand(yes, which);
  matches.undecided = which & ~expand(yes | no, which);
  matches.flat = expand(flat, which);
  return matches;
}

// A point of a plane, projected along an axis.
template <class Real>
struct PointPack {
  PackOf<Real> x, y;
};

// As coplanar_triangles_meet in triangle_triangle.cpp: along the axis of the largest part of the normal.
template <class Real>
struct Projection {
  MaskOf<Real> along_x, along_y;

  explicit Projection(const VectorOf<Real>& normal) {
    const PackOf<Real> x = abs(normal.x), y = abs(normal.y), z = abs(normal.z);
    along_x = both(less_equal(y, x), less_equal(z, x));
    along_y = without(less_equal(z, y), along_x);
  }
  PackOf<Real> component(const VectorOf<Real>& v) const { return select(along_x, v.x, select(along_y, v.y, v.z)); }
  PointPack<Real> operator()(const VectorOf<Real>& p) const {
    return {select(along_x, p.y, select(along_y, p.z, p.x)), select(along_x, p.z, select(along_y, p.x, p.y))};
  }
};

}  // namespace
}  // namespace tact::narrowphase

// Which of many pairs of facets meet: by the signs of determinants, as in triangle_triangle.cpp.
// In doubles; where these cannot tell, by equal corners, within the plane that both lie in, and in double-double; what
// is left is for exact predicates.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/clear_pairs.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/pair_lanes.inl"
#include "narrowphase/kernels/wide_packs.inl"

namespace tact::narrowphase {
namespace {

// As Plane, in double-double. No product may vanish (see nothing_vanishes).
//
// With u = 2^-53: a difference has no error, a product one of at most 7u², a sum one of 6u² of the sum of the sizes of
// what it adds. So each of the three products of three collects at most 20u² of the sum of the sizes of its products,
// and the two last sums 12u² more; the sizes, which are doubles, may be a few u too low. 64u² leaves room for all of
// it.
struct WidePlane {
  VectorPack origin, bound;
  WideVector normal;

  WidePlane(const VectorPack& c0, const VectorPack& c1, const VectorPack& c2)
      : origin(c0), bound(Plane(c0, c1, c2).bound) {
    normal = cross(difference(c1, c0), difference(c2, c0));
  }

  Determinant height(const VectorPack& point) const {
    const WideVector p = difference(point, origin);
    const WidePack value = dot(p, normal);
    const Pack size = add(add(mul(abs(p.x.high), bound.x), mul(abs(p.y.high), bound.y)), mul(abs(p.z.high), bound.z));
    return {value.high, add(mul(size, spread(kWideRelativeRounding)), spread(kAbsoluteRounding)), size};
  }
};

// The lanes in which no coordinate is so small that a product of three differences that are not zero could vanish: all
// are zero or at least 2^-200, so differences are at least 2^-252 and products 2^-756.
inline unsigned nothing_vanishes(const VectorPack* corner) {
  const Pack least = spread(0x1p-200), zero = spread(0.0);
  unsigned tiny = 0;
  for (int k = 0; k < 3; ++k) {
    const Pack coordinates[3] = {corner[k].x, corner[k].y, corner[k].z};
    for (const Pack x : coordinates) {
      tiny |= bits(both(less(abs(x), least), not_equal(x, zero)));
    }
  }
  return ~tiny;
}

// The policy for signs where each determinant has a bound of its own: tight with Plane, wide with WidePlane.
template <class AnyPlane>
struct BoundedSigns {
  using Real = double;
  static constexpr bool kTrustsZero = false;

  PlaneSides<double> sides(const VectorPack* plane, const VectorPack* corner) const {
    const AnyPlane of(plane[0], plane[1], plane[2]);
    PlaneSides<double> sides;
    Mask below[3], zero[3], strict[3], on_any[3];
    for (int k = 0; k < 3; ++k) {
      const Determinant height = of.height(corner[k]);
      sides.above[k] = height.positive();
      below[k] = height.negative();
      zero[k] = height.zero();
      strict[k] = either(sides.above[k], below[k]);
      on_any[k] = either(strict[k], zero[k]);
    }
    sides.apart = bits(all_of(sides.above)) | bits(all_of(below));
    sides.strict = bits(all_of(strict));
    sides.known = bits(all_of(on_any));
    sides.flat = bits(all_of(zero));
    const Mask any_above = any_of(sides.above);
    for (int k = 0; k < 3; ++k) sides.above[k] = either(sides.above[k], without(zero[k], any_above));
    return sides;
  }
  PiecesMeet pieces(const CommonLine<double>& line) const {
    const Determinant p = AnyPlane(line.b1, line.a1, line.lone_b).height(line.lone_a);
    const Determinant q = AnyPlane(line.b2, line.a2, line.lone_b).height(line.lone_a);
    return {bits(both(either(p.positive(), p.zero()), either(q.negative(), q.zero()))),
            bits(either(p.negative(), q.positive())), bits(either(p.zero(), q.zero()))};
  }
  unsigned trusts_zero(const VectorPack* corner) const { return nothing_vanishes(corner); }
};
using TightSigns = BoundedSigns<Plane>;
using WideSigns = BoundedSigns<WidePlane>;

// The rounding of all pairs together is soon known, and most are clear of it. Where a pair is not, others are likely
// not.
inline Meeting match_rounding_lanes(const VectorPack* a, const VectorPack* b, unsigned mask,
                                    const LooseSigns<double>& loose, bool* clear) {
  const Meeting meeting = *clear ? match_lanes(loose, a, b, mask) : Meeting{0, 0, 0};
  *clear = (meeting.yes | meeting.no) == mask;
  return *clear ? meeting : match_lanes(TightSigns{}, a, b, mask);
}

PairMatches match_pairs(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs, std::uint64_t which,
                        const BoxBounds& bounds) {
  const LooseSigns<double> loose(rounding_in(bounds));
  bool clear = true;
  return match_some(a, b, pairs, which, [&](const VectorPack* p, const VectorPack* q, unsigned lanes) {
    return match_rounding_lanes(p, q, lanes, loose, &clear);
  });
}

// Equal points.
inline Mask same(const VectorPack& a, const VectorPack& b) {
  return without(mask_of(kAllLanes), either(either(not_equal(a.x, b.x), not_equal(a.y, b.y)), not_equal(a.z, b.z)));
}

std::uint64_t sharing_pairs(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs, std::uint64_t which) {
  const auto share = [](const VectorPack* p, const VectorPack* q, unsigned lanes) -> Meeting {
    Mask any = mask_of(0);
    for (int i = 0; i < 3; ++i) any = either(any, either(either(same(p[i], q[0]), same(p[i], q[1])), same(p[i], q[2])));
    return {bits(any) & lanes, 0, 0};
  };
  return match_some(a, b, pairs, which, share).meeting;
}

PairMatches match_pairs_wide(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                             std::uint64_t which) {
  return match_some(a, b, pairs, which, [](const VectorPack* p, const VectorPack* q, unsigned lanes) {
    return match_lanes(WideSigns{}, p, q, lanes & nothing_vanishes(p) & nothing_vanishes(q));
  });
}

// The turn from a over b to c, which rounds less than a determinant of three rows. A product that vanishes is not zero:
// see nothing_vanishes.
inline Determinant turn(const PointPack<double>& a, const PointPack<double>& b, const PointPack<double>& c) {
  const Pack left = mul(sub(b.x, a.x), sub(c.y, a.y)), right = mul(sub(b.y, a.y), sub(c.x, a.x));
  const Pack size = add(abs(left), abs(right));
  return {sub(left, right), rounding_of(size), size};
}

// Lanes in which, certainly, some side of `t`, which turns to the left where `left` is set, has all of `other` strictly
// beyond it; and lanes in which no side has.
struct SideSeparation {
  Mask some = mask_of(0), none = mask_of(kAllLanes);

  void add_sides(const PointPack<double>* t, Mask left, const PointPack<double>* other) {
    for (int i = 0; i < 3; ++i) {
      Mask all_beyond = mask_of(kAllLanes), any_not = mask_of(0);
      for (int k = 0; k < 3; ++k) {
        const Determinant d = turn(t[i], t[(i + 1) % 3], other[k]);
        const Mask positive = d.positive(), negative = d.negative();
        const Mask inside = either(both(left, positive), without(negative, left));
        all_beyond = both(all_beyond, either(both(left, negative), without(positive, left)));
        any_not = either(any_not, either(inside, d.zero()));
      }
      some = either(some, all_beyond);
      none = both(none, any_not);
    }
  }
};

// Triangles of one plane are apart if and only if a side of one has the other beyond it.
inline Meeting match_flat_lanes(const VectorPack* a, const VectorPack* b, unsigned mask) {
  const Plane plane_a(a[0], a[1], a[2]), plane_b(b[0], b[1], b[2]);
  const Projection<double> project(plane_b.normal);
  const Pack turn_a = project.component(plane_a.normal), turn_b = project.component(plane_b.normal);
  const Pack error_a = rounding_of(project.component(plane_a.bound));
  const Pack error_b = rounding_of(project.component(plane_b.bound));
  const unsigned known = mask & bits(both(less(error_a, abs(turn_a)), less(error_b, abs(turn_b))));
  if (known == 0) return {0, 0, 0};
  const PointPack<double> p[3] = {project(a[0]), project(a[1]), project(a[2])};
  const PointPack<double> q[3] = {project(b[0]), project(b[1]), project(b[2])};
  const Pack zero = spread(0.0);
  SideSeparation separation;
  separation.add_sides(q, less(zero, turn_b), p);
  separation.add_sides(p, less(zero, turn_a), q);
  return {known & bits(separation.none), known & bits(separation.some), mask};
}

PairMatches match_flat_pairs(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs,
                             std::uint64_t which) {
  return match_some(a, b, pairs, which, [](const VectorPack* p, const VectorPack* q, unsigned lanes) {
    return match_flat_lanes(p, q, lanes & nothing_vanishes(p) & nothing_vanishes(q));
  });
}

}  // namespace
}  // namespace tact::narrowphase

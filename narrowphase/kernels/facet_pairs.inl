// Which of many pairs of facets meet, included by kernels.inl: by the signs of determinants, as in triangle_triangle.cpp.
// First in doubles; where these cannot tell, by equal corners, then in numbers of twice the digits; what is left is for
// exact predicates.

// A number of twice the digits: high + low, where high is the sum rounded. The arithmetic is that of Dekker, "A
// floating-point technique for extending the available precision", 1971, but for sums, which leave out a step that matters
// only to the relative error of what cancels (Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic
// building blocks of double-word arithmetic", 2017).
struct WidePack {
  Pack high, low;
};

// a + b where |a| >= |b|, or nearly so.
inline WidePack quick_sum(Pack a, Pack b) {
  const Pack sum = add(a, b);
  return {sum, sub(b, sub(sum, a))};
}

inline WidePack difference(Pack a, Pack b) {
  const Pack d = sub(a, b), part_b = sub(a, d), part_a = add(d, part_b);
  return {d, add(sub(part_b, b), sub(a, part_a))};
}

inline WidePack add(const WidePack& a, const WidePack& b) {
  const Pack sum = add(a.high, b.high), part_b = sub(sum, a.high), part_a = sub(sum, part_b);
  const Pack error = add(sub(a.high, part_a), sub(b.high, part_b));
  return quick_sum(sum, add(error, add(a.low, b.low)));
}

inline WidePack mul(const WidePack& a, const WidePack& b) {
  const Pack product = mul(a.high, b.high), error = fused(a.high, b.high, product);
  return quick_sum(product, add(error, add(mul(a.high, b.low), mul(a.low, b.high))));
}

inline WidePack sub(const WidePack& a, const WidePack& b) {
  const Pack zero = spread(0.0);
  return add(a, {sub(zero, b.high), sub(zero, b.low)});
}

struct WideVector {
  WidePack x, y, z;
};

inline WideVector difference(const VectorPack& a, const VectorPack& b) {
  return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

// As Plane, with twice the digits. No product may vanish (see nothing_vanishes).
//
// With u = 2^-53: a difference has no error, a product one of at most 7u², a sum one of 6u² of the sum of the sizes of
// what it adds. So each of the three products of three collects at most 20u² of the sum of the sizes of its products, and
// the two last sums 12u² more; the sizes, which are doubles, may be a few u too low. 64u² leaves room for all of it.
struct WidePlane {
  VectorPack origin, bound;
  WideVector normal;

  WidePlane(const VectorPack& c0, const VectorPack& c1, const VectorPack& c2)
      : origin(c0), bound(Plane(c0, c1, c2).bound) {
    const WideVector e = difference(c1, c0), f = difference(c2, c0);
    normal = {sub(mul(e.y, f.z), mul(e.z, f.y)), sub(mul(e.z, f.x), mul(e.x, f.z)), sub(mul(e.x, f.y), mul(e.y, f.x))};
  }

  Determinant height(const VectorPack& point) const {
    const WideVector p = difference(point, origin);
    const WidePack value = add(add(mul(p.x, normal.x), mul(p.y, normal.y)), mul(p.z, normal.z));
    const Pack size = add(add(mul(abs(p.x.high), bound.x), mul(abs(p.y.high), bound.y)), mul(abs(p.z.high), bound.z));
    return {value.high, add(mul(size, spread(kWideRelativeRounding)), spread(kAbsoluteRounding)), size};
  }
};

// On which side of a plane the corners of a triangle certainly lie.
struct Sides {
  Mask above[3], below[3], zero[3];
  unsigned apart;    // bits: all three strictly on one side
  unsigned certain;  // all three strictly on a side
  unsigned known;    // all three on a side or in the plane
  unsigned flat;     // all three in the plane

  template <class AnyPlane>
  Sides(const AnyPlane& plane, const VectorPack* corner) {
    Mask strict[3], on_any[3];
    for (int k = 0; k < 3; ++k) {
      const Determinant height = plane.height(corner[k]);
      above[k] = height.positive();
      below[k] = height.negative();
      zero[k] = height.zero();
      strict[k] = either(above[k], below[k]);
      on_any[k] = either(strict[k], zero[k]);
    }
    const auto all = [](const Mask* m) { return bits(both(both(m[0], m[1]), m[2])); };
    apart = all(above) | all(below);
    certain = all(strict);
    known = all(on_any);
    flat = all(zero);
  }
};

inline VectorPack select(Mask mask, const VectorPack& yes, const VectorPack& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

// A triangle with its corners turned so that the plane of the other parts the first from the other two, which it crosses
// both edges to. `above` tells on which side the first is, or would be if the others decide that it is in the plane.
struct LoneCorner {
  VectorPack lone, next, last;
  Mask above;
};

// The corners must neither be all strictly on one side nor all in the plane. As kLoneCorners in triangle_triangle.cpp.
inline LoneCorner lone_corner(const VectorPack* c, const Sides& s) {
  Mask up[3], here[3];
  for (int i = 0; i < 3; ++i) {
    const int n = (i + 1) % 3, l = (i + 2) % 3;
    const Mask others_below = both(either(s.below[n], s.zero[n]), either(s.below[l], s.zero[l]));
    const Mask others_above = both(either(s.above[n], s.zero[n]), either(s.above[l], s.zero[l]));
    up[i] = either(both(s.above[i], others_below), both(s.zero[i], both(s.below[n], s.below[l])));
    here[i] = either(up[i], either(both(s.below[i], others_above), both(s.zero[i], both(s.above[n], s.above[l]))));
  }
  const Mask second = without(here[1], here[0]), third = without(without(here[2], here[0]), here[1]);
  return {select(here[0], c[0], select(here[1], c[1], c[2])), select(here[0], c[1], select(here[1], c[2], c[0])),
          select(here[0], c[2], select(here[1], c[0], c[1])),
          either(both(here[0], up[0]), either(both(second, up[1]), both(third, up[2])))};
}

struct Meeting {
  unsigned yes, no, flat;  // bits of lanes that are certain; of the others, those where `a` lies in the plane of `b`
};

// Bits of lanes that are certain, and of those that hang on a determinant being zero.
struct IntervalMeeting {
  unsigned yes, no, by_zero;
};

// Each triangle crosses or touches the other's plane: their intervals on the common line overlap if and only if two
// orientations of an edge of each have the right signs (Guigue and Devillers, 2003). As in triangle_triangle.cpp, where
// above is a negative orientation.
template <class AnyPlane>
inline IntervalMeeting intervals_meet(const LoneCorner& a, const LoneCorner& b) {
  const VectorPack b1 = select(a.above, b.next, b.last), b2 = select(a.above, b.last, b.next);
  const VectorPack a1 = select(b.above, a.next, a.last), a2 = select(b.above, a.last, a.next);
  const Determinant p = AnyPlane(b1, a1, b.lone).height(a.lone), q = AnyPlane(b2, a2, b.lone).height(a.lone);
  return {bits(both(either(p.positive(), p.zero()), either(q.negative(), q.zero()))),
          bits(either(p.negative(), q.positive())), bits(either(p.zero(), q.zero()))};
}

inline void gather_corners(const FacetBlock& block, const std::uint8_t* facet, VectorPack* corner) {
  for (int k = 0; k < 3; ++k) {
    corner[k] = {gather(block.corner[k][0], facet), gather(block.corner[k][1], facet),
                 gather(block.corner[k][2], facet)};
  }
}

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

// By the sides of the planes, then by the intervals on their common line.
template <class AnyPlane>
inline Meeting match_lanes(const VectorPack* a, const VectorPack* b, unsigned mask) {
  const Sides sides_b(AnyPlane(a[0], a[1], a[2]), b);
  unsigned left = mask & ~sides_b.apart;
  if (left == 0) return {0, mask, 0};
  const Sides sides_a(AnyPlane(b[0], b[1], b[2]), a);
  left &= ~sides_a.apart;
  const unsigned certain = left & sides_a.certain & sides_b.certain;
  const unsigned known = left & sides_a.known & sides_b.known & ~(sides_a.flat | sides_b.flat);
  const unsigned flat = left & sides_a.flat;
  if (known == 0 && flat == 0) return {0, mask & ~left, 0};
  IntervalMeeting meeting = intervals_meet<AnyPlane>(lone_corner(a, sides_a), lone_corner(b, sides_b));
  const unsigned in_plane = known & ~certain, by_zero = in_plane | (known & meeting.by_zero) | flat;
  unsigned vanishing = 0;
  if (by_zero != 0) {
    vanishing = by_zero & ~(nothing_vanishes(a) & nothing_vanishes(b));
    meeting.yes &= ~vanishing;
    meeting.no &= ~(vanishing & in_plane);
  }
  return {meeting.yes & known, (mask & ~left) | (meeting.no & known), flat & ~vanishing};
}

// On which side of a plane the corners of a triangle lie, by their heights over it.
struct StrictSides {
  Mask above[3];
  unsigned apart, certain;  // bits: all three on one side; all three farther away than rounding

  StrictSides(const Plane& plane, const VectorPack* corner, Pack error) {
    Mask below[3];
    for (int k = 0; k < 3; ++k) {
      const Pack height = plane.height(corner[k]).value;
      above[k] = less(error, height);
      below[k] = less(height, sub(spread(0.0), error));
    }
    const Mask all_above = both(both(above[0], above[1]), above[2]), all_below = both(both(below[0], below[1]), below[2]);
    apart = bits(either(all_above, all_below));
    certain = bits(both(both(either(above[0], below[0]), either(above[1], below[1])), either(above[2], below[2])));
  }
};

// Of three sides two are equal: the lone corner is on that which an odd number are on.
inline LoneCorner lone_corner(const VectorPack* c, const StrictSides& s) {
  const Mask not_first = differ(s.above[1], s.above[2]), third = differ(s.above[0], s.above[2]);
  const auto turned = [&](int first) {
    return select(not_first, select(third, c[(first + 2) % 3], c[(first + 1) % 3]), c[first]);
  };
  return {turned(0), turned(1), turned(2), differ(s.above[0], not_first)};
}

// What match_lanes<Plane> says, where determinants larger than `error`, which is not below their own, suffice; nothing of
// other lanes.
inline Meeting match_clear_lanes(const VectorPack* a, const VectorPack* b, unsigned mask, Pack error) {
  const StrictSides sides_b(Plane(a[0], a[1], a[2]), b, error);
  unsigned left = mask & ~sides_b.apart;
  if (left == 0) return {0, mask, 0};
  const StrictSides sides_a(Plane(b[0], b[1], b[2]), a, error);
  left &= ~sides_a.apart;
  const unsigned certain = left & sides_a.certain & sides_b.certain;
  if (certain == 0) return {0, mask & ~left, 0};
  const LoneCorner lone_a = lone_corner(a, sides_a), lone_b = lone_corner(b, sides_b);
  const VectorPack b1 = select(lone_a.above, lone_b.next, lone_b.last), b2 = select(lone_a.above, lone_b.last, lone_b.next);
  const VectorPack a1 = select(lone_b.above, lone_a.next, lone_a.last), a2 = select(lone_b.above, lone_a.last, lone_a.next);
  const Pack p = Plane(b1, a1, lone_b.lone).height(lone_a.lone).value;
  const Pack q = Plane(b2, a2, lone_b.lone).height(lone_a.lone).value;
  const Pack opposite_error = sub(spread(0.0), error);
  const unsigned yes = bits(both(less(error, p), less(q, opposite_error)));
  const unsigned no = bits(either(less(p, opposite_error), less(error, q)));
  return {yes & certain, (mask & ~left) | (no & certain), 0};
}

// The rounding of all pairs together is soon known, and most are clear of it. Where a pair is not, others are likely not.
PairMatches match_pairs(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs, const BoxBounds& bounds) {
  PairMatches matches{0, 0, 0};
  const Pack error = rounding_in(bounds);
  bool clear = true;
  for (int i = 0; i < pairs.count; i += kWidth) {
    VectorPack corner_a[3], corner_b[3];
    gather_corners(a, pairs.a + i, corner_a);
    gather_corners(b, pairs.b + i, corner_b);
    const unsigned mask = lanes_left(pairs.count - i);
    Meeting meeting = clear ? match_clear_lanes(corner_a, corner_b, mask, error) : Meeting{0, 0, 0};
    clear = (meeting.yes | meeting.no) == mask;
    if (!clear) meeting = match_lanes<Plane>(corner_a, corner_b, mask);
    matches.meeting |= static_cast<std::uint64_t>(meeting.yes) << i;
    matches.undecided |= static_cast<std::uint64_t>(mask & ~(meeting.yes | meeting.no)) << i;
    matches.flat |= static_cast<std::uint64_t>(meeting.flat) << i;
  }
  return matches;
}

// Those of the pairs that have a bit in `which`, a pack at a time: calls judge(corners of a, corners of b, lanes, place),
// where lane k is pair place[k].
template <class Judge>
inline void for_each_pack(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs, std::uint64_t which,
                          const Judge& judge) {
  while (which != 0) {
    std::int32_t place[kWidth];
    std::uint8_t facet_a[kWidth], facet_b[kWidth];
    int count = 0;
    for (; count < kWidth && which != 0; which &= which - 1) place[count++] = __builtin_ctzll(which);
    for (int k = count; k < kWidth; ++k) place[k] = place[0];
    for (int k = 0; k < kWidth; ++k) {
      facet_a[k] = pairs.a[place[k]];
      facet_b[k] = pairs.b[place[k]];
    }
    VectorPack corner_a[3], corner_b[3];
    gather_corners(a, facet_a, corner_a);
    gather_corners(b, facet_b, corner_b);
    judge(corner_a, corner_b, lanes_left(count), place);
  }
}

// Lanes as bits of the list.
inline std::uint64_t in_list(unsigned lanes, const std::int32_t* place) {
  std::uint64_t bits = 0;
  for (; lanes != 0; lanes &= lanes - 1) bits |= std::uint64_t{1} << place[__builtin_ctz(lanes)];
  return bits;
}

// Equal points.
inline Mask same(const VectorPack& a, const VectorPack& b) {
  return without(mask_of(kAllLanes), either(either(not_equal(a.x, b.x), not_equal(a.y, b.y)), not_equal(a.z, b.z)));
}

std::uint64_t sharing_pairs(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs, std::uint64_t which) {
  std::uint64_t sharing = 0;
  for_each_pack(a, b, pairs, which, [&](const VectorPack* p, const VectorPack* q, unsigned lanes, const std::int32_t* place) {
    Mask any = mask_of(0);
    for (int i = 0; i < 3; ++i) any = either(any, either(either(same(p[i], q[0]), same(p[i], q[1])), same(p[i], q[2])));
    sharing |= in_list(bits(any) & lanes, place);
  });
  return sharing;
}

PairMatches match_pairs_wide(const FacetBlock& a, const FacetBlock& b, const FacetPairList& pairs, std::uint64_t which) {
  PairMatches matches{0, 0, 0};
  for_each_pack(a, b, pairs, which, [&](const VectorPack* p, const VectorPack* q, unsigned lanes, const std::int32_t* place) {
    const Meeting meeting = match_lanes<WidePlane>(p, q, lanes & nothing_vanishes(p) & nothing_vanishes(q));
    matches.meeting |= in_list(meeting.yes, place);
    matches.undecided |= in_list(lanes & ~(meeting.yes | meeting.no), place);
    matches.flat |= in_list(meeting.flat, place);
  });
  return matches;
}

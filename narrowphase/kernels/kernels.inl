// The loops of kernels.h over the packs that the including file defines. A tail of fewer than kWidth elements is read from
// a padded array where the caller promises padding (points, boxes: see ClusteredMesh) and its lanes are masked off.

namespace tact::narrowphase {
namespace {

constexpr unsigned kAllLanes = (1u << kWidth) - 1u;

inline unsigned lanes_left(int left) { return left >= kWidth ? kAllLanes : (1u << left) - 1u; }

inline int append(unsigned mask, int first, std::int32_t* indices, int found) {
  while (mask != 0) {
    indices[found++] = first + __builtin_ctz(mask);
    mask &= mask - 1;
  }
  return found;
}

constexpr double kLaneIndex[8] = {0, 1, 2, 3, 4, 5, 6, 7};

struct HeightPack {
  Pack nx, ny, nz, ox, oy, oz;
  explicit HeightPack(const HeightAxis& axis)
      : nx(spread(axis.nx)), ny(spread(axis.ny)), nz(spread(axis.nz)),
        ox(spread(axis.ox)), oy(spread(axis.oy)), oz(spread(axis.oz)) {}
  Pack operator()(PointArrays points, int i) const {
    const Pack x = mul(nx, sub(load(points.x + i), ox));
    const Pack y = mul(ny, sub(load(points.y + i), oy));
    const Pack z = mul(nz, sub(load(points.z + i), oz));
    return add(add(x, y), z);
  }
};

std::int64_t find_large(const double* source, std::int64_t count, double largest) {
  const Pack limit = spread(largest);
  std::int64_t i = 0;
  for (; i + 4 * kWidth <= count; i += 4 * kWidth) {
    const Mask good = both(both(less_equal(abs(load(source + i)), limit), less_equal(abs(load(source + i + kWidth)), limit)),
                           both(less_equal(abs(load(source + i + 2 * kWidth)), limit),
                                less_equal(abs(load(source + i + 3 * kWidth)), limit)));
    if (bits(good) != kAllLanes) break;
  }
  for (; i < count; ++i) {
    if (!(__builtin_fabs(source[i]) <= largest)) return i;
  }
  return -1;
}

void heights(PointArrays points, int count, const HeightAxis& axis, double* out) {
  const HeightPack height(axis);
  for (int i = 0; i < count; i += kWidth) store(out + i, height(points, i));
}

int select_heights(PointArrays points, int count, const HeightAxis& axis, double threshold, std::int32_t* indices) {
  const HeightPack height(axis);
  const Pack least = spread(threshold);
  int found = 0;
  for (int i = 0; i < count; i += kWidth) {
    found = append(bits(less_equal(least, height(points, i))) & lanes_left(count - i), i, indices, found);
  }
  return found;
}

BoxBounds bounds(const BoxPointers& boxes, int count) {
  const Pack infinite = spread(__builtin_inf()), zero = spread(0.0);
  BoxBounds result;
  for (int axis = 0; axis < 3; ++axis) {
    Pack low = infinite, high = infinite;  // of the opposite of the upper bounds
    for (int i = 0; i < count; i += kWidth) {
      const Mask lanes = mask_of(lanes_left(count - i));
      low = min(low, select(lanes, load(boxes.lower[axis] + i), infinite));
      high = min(high, select(lanes, sub(zero, load(boxes.upper[axis] + i)), infinite));
    }
    // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
    result.lower[axis] = -largest_lane(sub(zero, low)) + 0.0;
    result.upper[axis] = largest_lane(sub(zero, high)) + 0.0;
  }
  return result;
}

// One pass: a lane keeps its highest point, the first of equals, and whether there are equals.
HighestPoint highest_point(PointArrays points, int count, const HeightAxis& axis) {
  const HeightPack height(axis);
  const Pack end = spread(count), step = spread(kWidth);
  Pack index = load(kLaneIndex), best = spread(-__builtin_inf()), best_index = index;
  Mask tied = less(end, end);
  for (int i = 0; i < count; i += kWidth, index = add(index, step)) {
    const Pack h = select(less(index, end), height(points, i), spread(-__builtin_inf()));
    const Mask higher = less(best, h);
    tied = either(both(tied, less_equal(h, best)), both(less_equal(h, best), less_equal(best, h)));
    best = select(higher, h, best);
    best_index = select(higher, index, best_index);
  }
  const double top = largest_lane(best);
  unsigned lanes = bits(less_equal(spread(top), best));
  const bool several = (lanes & (lanes - 1)) != 0 || (lanes & bits(tied)) != 0;
  double first[kWidth];
  store(first, best_index);
  double lowest = first[__builtin_ctz(lanes)];
  while ((lanes &= lanes - 1) != 0) {
    const double other = first[__builtin_ctz(lanes)];
    if (other < lowest) lowest = other;
  }
  return {top, static_cast<std::int32_t>(lowest), several};
}

struct BoxPack {
  Pack lower[3], upper[3];
  explicit BoxPack(const BoxBounds& box) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = spread(box.lower[axis]);
      upper[axis] = spread(box.upper[axis]);
    }
  }
  unsigned overlap(const double* const* low, const double* const* high, int i) const {
    Mask all = both(less_equal(load(low[0] + i), upper[0]), less_equal(lower[0], load(high[0] + i)));
    for (int axis = 1; axis < 3; ++axis) {
      all = both(all, both(less_equal(load(low[axis] + i), upper[axis]), less_equal(lower[axis], load(high[axis] + i))));
    }
    return bits(all);
  }
};

int select_overlapping(const BoxPointers& boxes, int count, const BoxBounds& box, std::int32_t* indices) {
  const BoxPack pack(box);
  int found = 0;
  for (int i = 0; i < count; i += kWidth) {
    found = append(pack.overlap(boxes.lower, boxes.upper, i) & lanes_left(count - i), i, indices, found);
  }
  return found;
}

void fill_facet_block(PointArrays points, const std::int32_t* const corners[3], int count, FacetBlock* block) {
  const double* const coordinate[3] = {points.x, points.y, points.z};
  for (int i = 0; i < count; i += kWidth) {
    // The arrays of corners are padded to a whole number of packs, with vertices that exist.
    for (int axis = 0; axis < 3; ++axis) {
      const Pack p0 = gather(coordinate[axis], corners[0] + i);
      const Pack p1 = gather(coordinate[axis], corners[1] + i);
      const Pack p2 = gather(coordinate[axis], corners[2] + i);
      store(block->corner[0][axis] + i, p0);
      store(block->corner[1][axis] + i, p1);
      store(block->corner[2][axis] + i, p2);
      store(block->lower[axis] + i, min(min(p0, p1), p2));
      store(block->upper[axis] + i, max(max(p0, p1), p2));
    }
  }
}

struct VectorPack {
  Pack x, y, z;
};

inline VectorPack sub(const VectorPack& a, const VectorPack& b) { return {sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)}; }
inline VectorPack spread(const double* p) { return {spread(p[0]), spread(p[1]), spread(p[2])}; }

// A determinant as computed, and a bound of its rounding.
struct Determinant {
  Pack value, error;
  Mask positive() const { return less(error, value); }
  Mask negative() const { return less(value, sub(spread(0.0), error)); }
};

// A 3 x 3 determinant of differences, x · n with n = e × f, rounds by at most (7 + 56 eps) eps times the same sum of absolute
// products, eps = 2^-53 (Shewchuk, "Adaptive precision floating-point arithmetic", 1997, §4.4), so by less than 1e-15 times
// it. Where products vanish below the smallest double, each of the nine loses at most 2^-1075 times a difference;
// differences of coordinates <= 2^300 make that less than the added 1e-200.
inline Determinant determinant(const VectorPack& x, const VectorPack& n, const VectorPack& n_bound) {
  const Pack value = add(add(mul(n.x, x.x), mul(n.y, x.y)), mul(n.z, x.z));
  const Pack size = add(add(mul(n_bound.x, abs(x.x)), mul(n_bound.y, abs(x.y))), mul(n_bound.z, abs(x.z)));
  return {value, add(mul(size, spread(1e-15)), spread(1e-200))};
}

// On which side of a plane the corners of a triangle certainly lie.
struct Sides {
  Mask above[3];
  Mask certain;   // all three
  unsigned apart; // bits: all three on one side
};

struct SideFilter {
  VectorPack origin, normal, bound;

  Sides sides(const VectorPack* corner) const {
    Sides s;
    Mask below[3];
    for (int k = 0; k < 3; ++k) {
      const Determinant height = determinant(sub(corner[k], origin), normal, bound);
      s.above[k] = height.positive();
      below[k] = height.negative();
    }
    const Mask all_above = both(both(s.above[0], s.above[1]), s.above[2]), all_below = both(both(below[0], below[1]), below[2]);
    s.apart = bits(either(all_above, all_below));
    s.certain = both(both(either(s.above[0], below[0]), either(s.above[1], below[1])), either(s.above[2], below[2]));
    return s;
  }
};

inline SideFilter plane_of(const VectorPack& c0, const VectorPack& c1, const VectorPack& c2) {
  const VectorPack e = sub(c1, c0), f = sub(c2, c0);
  const Pack xy = mul(e.y, f.z), xz = mul(e.z, f.y), yz = mul(e.z, f.x), yx = mul(e.x, f.z), zx = mul(e.x, f.y), zy = mul(e.y, f.x);
  return {c0,
          {sub(xy, xz), sub(yz, yx), sub(zx, zy)},
          {add(abs(xy), abs(xz)), add(abs(yz), abs(yx)), add(abs(zx), abs(zy))}};
}

CullBits cull_facets(const FacetBlock& block, int count, const CullPlanes& planes) {
  const BoxPack box(planes.box);
  const HeightPack height(planes.axis);
  const Pack lowest = spread(planes.lowest), zero = spread(0.0);
  const double* const lower[3] = {block.lower[0], block.lower[1], block.lower[2]};
  const double* const upper[3] = {block.upper[0], block.upper[1], block.upper[2]};
  CullBits result{count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1, 0, 0};
  for (int i = 0; i < count; i += kWidth) {
    unsigned reaching = box.overlap(lower, upper, i);
    Pack top = height({block.corner[0][0], block.corner[0][1], block.corner[0][2]}, i);
    for (int k = 1; k < 3; ++k) top = max(top, height({block.corner[k][0], block.corner[k][1], block.corner[k][2]}, i));
    reaching &= bits(less_equal(lowest, top));
    result.reaching |= static_cast<std::uint64_t>(reaching) << i;
    if (!planes.facing_away) continue;
    VectorPack c[3];
    for (int k = 0; k < 3; ++k) c[k] = {load(block.corner[k][0] + i), load(block.corner[k][1] + i), load(block.corner[k][2] + i)};
    const VectorPack n = plane_of(c[0], c[1], c[2]).normal;
    const Pack along = add(add(mul(height.nx, n.x), mul(height.ny, n.y)), mul(height.nz, n.z));
    const Mask area = either(either(not_equal(n.x, zero), not_equal(n.y, zero)), not_equal(n.z, zero));
    result.facing_away |= static_cast<std::uint64_t>(bits(both(less_equal(along, zero), area))) << i;
  }
  result.reaching &= result.all;
  result.facing_away &= result.all;
  return result;
}

inline VectorPack select(Mask mask, const VectorPack& yes, const VectorPack& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

// A triangle with its corners turned so that the first is alone on its side of the other's plane.
struct LoneCorner {
  VectorPack lone, next, last;
  Mask above;
};

inline LoneCorner lone_corner(const VectorPack* c, const Sides& s) {
  const Mask first = both(differ(s.above[0], s.above[1]), differ(s.above[0], s.above[2]));
  const Mask second = both(differ(s.above[1], s.above[0]), differ(s.above[1], s.above[2]));
  return {select(first, c[0], select(second, c[1], c[2])), select(first, c[1], select(second, c[2], c[0])),
          select(first, c[2], select(second, c[0], c[1])),
          either(both(first, s.above[0]), either(both(second, s.above[1]), both(both(differ(s.above[2], s.above[0]), differ(s.above[2], s.above[1])), s.above[2])))};
}

// (a - d) · ((b - d) × (c - d)).
inline Determinant orient3d(const VectorPack& a, const VectorPack& b, const VectorPack& c, const VectorPack& d) {
  const SideFilter plane = plane_of(d, b, c);
  return determinant(sub(a, d), plane.normal, plane.bound);
}

struct Meeting {
  unsigned yes, no;  // bits of lanes that are certain
};

// Both triangles cross the other's plane, no corner being near it: their intervals on the common line overlap if and only
// if two orientations of an edge of each have the right signs (Guigue and Devillers, 2003). As in triangle_triangle.cpp,
// where above is a negative orientation.
inline Meeting intervals_meet(const LoneCorner& a, const LoneCorner& b) {
  const VectorPack b1 = select(a.above, b.next, b.last), b2 = select(a.above, b.last, b.next);
  const VectorPack a1 = select(b.above, a.next, a.last), a2 = select(b.above, a.last, a.next);
  const Determinant p = orient3d(a.lone, a1, b.lone, b1), q = orient3d(a.lone, a2, b.lone, b2);
  return {bits(both(p.positive(), q.negative())), bits(either(p.negative(), q.positive()))};
}

// The lanes of the facets from `i` on that have a bit in `mask`, by plane sides and intervals.
inline Meeting match_lanes(const FacetBlock& block, int i, unsigned mask, const VectorPack* corner, const SideFilter& own) {
  VectorPack other[3];
  for (int k = 0; k < 3; ++k) {
    other[k] = {load(block.corner[k][0] + i), load(block.corner[k][1] + i), load(block.corner[k][2] + i)};
  }
  const Sides theirs = own.sides(other);
  unsigned left = mask & ~theirs.apart;
  if (left == 0) return {0, mask};
  const Sides ours = plane_of(other[0], other[1], other[2]).sides(corner);
  left &= ~ours.apart;
  const unsigned certain = bits(both(theirs.certain, ours.certain)) & left;
  if (certain == 0) return {0, mask & ~left};
  const Meeting meeting = intervals_meet(lone_corner(corner, ours), lone_corner(other, theirs));
  return {meeting.yes & certain, (mask & ~left) | (meeting.no & certain)};
}

FacetMatches match_facets(const FacetBlock& block, std::uint64_t candidates, const FilterFacet& facet) {
  const BoxPack box(facet.box);
  const double* const lower[3] = {block.lower[0], block.lower[1], block.lower[2]};
  const double* const upper[3] = {block.upper[0], block.upper[1], block.upper[2]};
  std::uint64_t overlapping = 0;
  while (candidates != 0) {
    const int i = __builtin_ctzll(candidates) / kWidth * kWidth;
    const unsigned mask = static_cast<unsigned>(candidates >> i) & kAllLanes;
    candidates &= ~(static_cast<std::uint64_t>(kAllLanes) << i);
    overlapping |= static_cast<std::uint64_t>(mask & box.overlap(lower, upper, i)) << i;
  }
  FacetMatches matches{0, 0, __builtin_popcountll(overlapping)};
  if (overlapping == 0) return matches;
  const VectorPack corner[3] = {spread(facet.corner[0]), spread(facet.corner[1]), spread(facet.corner[2])};
  const SideFilter own{corner[0], spread(facet.normal), spread(facet.normal_bound)};
  while (overlapping != 0) {
    const int i = __builtin_ctzll(overlapping) / kWidth * kWidth;
    const unsigned mask = static_cast<unsigned>(overlapping >> i) & kAllLanes;
    overlapping &= ~(static_cast<std::uint64_t>(kAllLanes) << i);
    const Meeting meeting = match_lanes(block, i, mask, corner, own);
    matches.meeting |= static_cast<std::uint64_t>(meeting.yes) << i;
    matches.undecided |= static_cast<std::uint64_t>(mask & ~(meeting.yes | meeting.no)) << i;
  }
  return matches;
}

NearFacets near_facets(const FacetBlock& block, std::uint64_t candidates, const BoxBounds& box) {
  const BoxPack pack(box);
  const double* const lower[3] = {block.lower[0], block.lower[1], block.lower[2]};
  const double* const upper[3] = {block.upper[0], block.upper[1], block.upper[2]};
  Pack low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = spread(__builtin_inf());
    high[axis] = spread(-__builtin_inf());
  }
  std::uint64_t near = 0;
  while (candidates != 0) {
    const int i = __builtin_ctzll(candidates) / kWidth * kWidth;
    const unsigned mask = static_cast<unsigned>(candidates >> i) & kAllLanes & pack.overlap(lower, upper, i);
    candidates &= ~(static_cast<std::uint64_t>(kAllLanes) << i);
    if (mask == 0) continue;
    near |= static_cast<std::uint64_t>(mask) << i;
    const Mask lanes = mask_of(mask);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = select(lanes, min(low[axis], load(lower[axis] + i)), low[axis]);
      high[axis] = select(lanes, max(high[axis], load(upper[axis] + i)), high[axis]);
    }
  }
  NearFacets result{near, box};
  for (int axis = 0; near != 0 && axis < 3; ++axis) {
    result.box.lower[axis] = -largest_lane(sub(spread(0.0), low[axis]));
    result.box.upper[axis] = largest_lane(high[axis]);
  }
  return result;
}

#if defined(TACT_KERNELS_AVX2_REFRESH)

// A vertex in the low three lanes, zero in the fourth.
inline __m256d load_vertex(const double* source, std::int32_t s) {
  const __m256i three = _mm256_set_epi64x(0, -1, -1, -1);
  return _mm256_maskload_pd(source + 3 * static_cast<std::int64_t>(s), three);
}

// Stores `value`; the lanes that were different.
inline __m256d replace(double* p, __m256d value) {
  const __m256d differs = _mm256_cmp_pd(_mm256_loadu_pd(p), value, _CMP_NEQ_UQ);
  _mm256_storeu_pd(p, value);
  return differs;
}

struct Bounds {
  __m256d lower = _mm256_set1_pd(__builtin_inf()), upper = _mm256_set1_pd(-__builtin_inf());
  void widen(__m256d v) {
    lower = _mm256_min_pd(lower, v);
    upper = _mm256_max_pd(upper, v);
  }
};

bool refresh_cluster(const RefreshInput& in, BoxBounds* box) {
  Bounds even, odd;  // two, so that one need not wait for the other
  __m256d differs = _mm256_setzero_pd();
  int i = 0;
  for (; i + 4 <= in.owned_count; i += 4) {
    const __m256d a = load_vertex(in.source, in.owned[i]), b = load_vertex(in.source, in.owned[i + 1]);
    const __m256d c = load_vertex(in.source, in.owned[i + 2]), d = load_vertex(in.source, in.owned[i + 3]);
    even.widen(a);
    odd.widen(b);
    even.widen(c);
    odd.widen(d);
    const __m256d xz02 = _mm256_unpacklo_pd(a, b), y02 = _mm256_unpackhi_pd(a, b);
    const __m256d xz13 = _mm256_unpacklo_pd(c, d), y13 = _mm256_unpackhi_pd(c, d);
    const __m256d x = replace(in.x + i, _mm256_permute2f128_pd(xz02, xz13, 0x20));
    const __m256d y = replace(in.y + i, _mm256_permute2f128_pd(y02, y13, 0x20));
    const __m256d z = replace(in.z + i, _mm256_permute2f128_pd(xz02, xz13, 0x31));
    differs = _mm256_or_pd(_mm256_or_pd(differs, x), _mm256_or_pd(y, z));
  }
  bool changed = _mm256_movemask_pd(differs) != 0;
  for (; i < in.owned_count; ++i) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    changed = changed || in.x[i] != p[0] || in.y[i] != p[1] || in.z[i] != p[2];
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    even.widen(load_vertex(in.source, in.owned[i]));
  }
  int k = 0;
  for (; k + 2 <= in.borrowed_count; k += 2) {
    even.widen(load_vertex(in.source, in.borrowed[k]));
    odd.widen(load_vertex(in.source, in.borrowed[k + 1]));
  }
  if (k < in.borrowed_count) even.widen(load_vertex(in.source, in.borrowed[k]));
  const __m256d lower = _mm256_min_pd(even.lower, odd.lower), upper = _mm256_max_pd(even.upper, odd.upper);
  // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
  double low[4], high[4];
  _mm256_storeu_pd(low, _mm256_add_pd(lower, _mm256_setzero_pd()));
  _mm256_storeu_pd(high, _mm256_add_pd(upper, _mm256_setzero_pd()));
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = low[axis];
    box->upper[axis] = high[axis];
  }
  return changed;
}

#else

inline void widen(BoxBounds* box, const double* p) {
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = min(box->lower[axis], p[axis]);
    box->upper[axis] = max(box->upper[axis], p[axis]);
  }
}

bool refresh_cluster(const RefreshInput& in, BoxBounds* box) {
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = __builtin_inf();
    box->upper[axis] = -__builtin_inf();
  }
  bool changed = false;
  for (int i = 0; i < in.owned_count; ++i) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    changed = changed || in.x[i] != p[0] || in.y[i] != p[1] || in.z[i] != p[2];
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    widen(box, p);
  }
  for (int k = 0; k < in.borrowed_count; ++k) {
    widen(box, in.source + 3 * static_cast<std::int64_t>(in.borrowed[k]));
  }
  // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] += 0.0;
    box->upper[axis] += 0.0;
  }
  return changed;
}

#endif

}  // namespace

extern const Kernels TACT_KERNELS;
const Kernels TACT_KERNELS = {TACT_KERNELS_NAME, find_large, refresh_cluster, bounds, heights, select_heights, highest_point,
                              select_overlapping, fill_facet_block, cull_facets, near_facets, match_facets};

}  // namespace tact::narrowphase

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
    const Mask good = less_equal(abs(load(source + i)), limit) & less_equal(abs(load(source + i + kWidth)), limit) &
                      less_equal(abs(load(source + i + 2 * kWidth)), limit) &
                      less_equal(abs(load(source + i + 3 * kWidth)), limit);
    if (good != kAllLanes) break;
  }
  for (; i < count; ++i) {
    if (!(__builtin_fabs(source[i]) <= largest)) return i;
  }
  return -1;
}

int select_heights(PointArrays points, int count, const HeightAxis& axis, double threshold, std::int32_t* indices) {
  const HeightPack height(axis);
  const Pack least = spread(threshold);
  int found = 0;
  for (int i = 0; i < count; i += kWidth) {
    found = append(less_equal(least, height(points, i)) & lanes_left(count - i), i, indices, found);
  }
  return found;
}

double max_height(PointArrays points, int count, const HeightAxis& axis, std::int32_t* index) {
  const HeightPack height(axis);
  int i = 0;
  Pack best = spread(-__builtin_inf());
  for (; i + kWidth <= count; i += kWidth) best = max(best, height(points, i));
  double largest = largest_lane(best);
  for (int k = i; k < count; ++k) {
    const double h = (axis.nx * (points.x[k] - axis.ox) + axis.ny * (points.y[k] - axis.oy)) + axis.nz * (points.z[k] - axis.oz);
    if (h > largest) largest = h;
  }
  const Pack wanted = spread(largest);
  for (int k = 0; k < count; k += kWidth) {
    const unsigned equal = less_equal(wanted, height(points, k)) & lanes_left(count - k);
    if (equal != 0) {
      *index = k + __builtin_ctz(equal);
      break;
    }
  }
  return largest;
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
    return less_equal(load(low[0] + i), upper[0]) & less_equal(lower[0], load(high[0] + i)) &
           less_equal(load(low[1] + i), upper[1]) & less_equal(lower[1], load(high[1] + i)) &
           less_equal(load(low[2] + i), upper[2]) & less_equal(lower[2], load(high[2] + i));
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

// The lanes in which three points are certainly all on one side of a plane. The height of p over the plane through c with
// normal (c1 - c) × (c2 - c) is a 3 x 3 determinant of differences; evaluated as here, its rounding is at most
// (7 + 56 eps) eps times the same sum of absolute products, eps = 2^-53 (Shewchuk, "Adaptive precision floating-point
// arithmetic", 1997, §4.4), so 1e-15 times it. Where products vanish below the smallest double, each of the nine loses at most 2^-1075,
// times a difference; differences of coordinates <= 2^300 make that less than the added 1e-200.
struct SideFilter {
  VectorPack origin, normal, bound;

  unsigned one_side(const VectorPack& p0, const VectorPack& p1, const VectorPack& p2) const {
    const Pack tiny = spread(1e-200), factor = spread(1e-15), zero = spread(0.0);
    const VectorPack points[3] = {p0, p1, p2};
    unsigned above = kAllLanes, below = kAllLanes;
    for (const VectorPack& p : points) {
      const VectorPack d = sub(p, origin);
      const Pack height = add(add(mul(normal.x, d.x), mul(normal.y, d.y)), mul(normal.z, d.z));
      const Pack size = add(add(mul(bound.x, abs(d.x)), mul(bound.y, abs(d.y))), mul(bound.z, abs(d.z)));
      const Pack error = add(mul(size, factor), tiny);
      above &= less(error, height);
      below &= less(height, sub(zero, error));
    }
    return above | below;
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
  CullBits bits{count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1, 0, 0};
  for (int i = 0; i < count; i += kWidth) {
    unsigned reaching = box.overlap(lower, upper, i);
    Pack top = height({block.corner[0][0], block.corner[0][1], block.corner[0][2]}, i);
    for (int k = 1; k < 3; ++k) top = max(top, height({block.corner[k][0], block.corner[k][1], block.corner[k][2]}, i));
    reaching &= less_equal(lowest, top);
    bits.reaching |= static_cast<std::uint64_t>(reaching) << i;
    if (!planes.facing_away) continue;
    VectorPack c[3];
    for (int k = 0; k < 3; ++k) c[k] = {load(block.corner[k][0] + i), load(block.corner[k][1] + i), load(block.corner[k][2] + i)};
    const VectorPack n = plane_of(c[0], c[1], c[2]).normal;
    const Pack along = add(add(mul(height.nx, n.x), mul(height.ny, n.y)), mul(height.nz, n.z));
    const unsigned area = not_equal(n.x, zero) | not_equal(n.y, zero) | not_equal(n.z, zero);
    bits.facing_away |= static_cast<std::uint64_t>(less_equal(along, zero) & area) << i;
  }
  bits.reaching &= bits.all;
  bits.facing_away &= bits.all;
  return bits;
}

int select_meeting(const FacetBlock& block, int count, const FilterFacet& facet, std::int32_t* indices,
                   std::int64_t* box_pairs) {
  const BoxPack box(facet.box);
  const double* const lower[3] = {block.lower[0], block.lower[1], block.lower[2]};
  const double* const upper[3] = {block.upper[0], block.upper[1], block.upper[2]};
  const VectorPack corner[3] = {spread(facet.corner[0]), spread(facet.corner[1]), spread(facet.corner[2])};
  const SideFilter own{corner[0], spread(facet.normal), spread(facet.normal_bound)};
  int found = 0;
  for (int i = 0; i < count; i += kWidth) {
    unsigned mask = box.overlap(lower, upper, i) & lanes_left(count - i);
    if (mask == 0) continue;
    *box_pairs += __builtin_popcount(mask);
    VectorPack other[3];
    for (int k = 0; k < 3; ++k) {
      other[k] = {load(block.corner[k][0] + i), load(block.corner[k][1] + i), load(block.corner[k][2] + i)};
    }
    mask &= ~own.one_side(other[0], other[1], other[2]);
    if (mask == 0) continue;
    mask &= ~plane_of(other[0], other[1], other[2]).one_side(corner[0], corner[1], corner[2]);
    found = append(mask, i, indices, found);
  }
  return found;
}

#if defined(TACT_KERNELS_AVX2_REFRESH)

// A vertex in the low three lanes. The load takes 8 bytes more than the vertex, but for the last of the array.
inline __m256d load_vertex(const RefreshInput& in, std::int32_t s) {
  const double* p = in.source + 3 * static_cast<std::int64_t>(s);
  return s + 1 < in.source_count ? _mm256_loadu_pd(p) : _mm256_set_pd(0.0, p[2], p[1], p[0]);
}

inline unsigned replace(double* p, __m256d value) {
  const __m256d differs = _mm256_cmp_pd(_mm256_loadu_pd(p), value, _CMP_NEQ_UQ);
  _mm256_storeu_pd(p, value);
  return static_cast<unsigned>(_mm256_movemask_pd(differs));
}

bool refresh_cluster(const RefreshInput& in, BoxBounds* box) {
  __m256d lower = _mm256_set1_pd(__builtin_inf()), upper = _mm256_set1_pd(-__builtin_inf());
  unsigned changed = 0;
  int i = 0;
  for (; i + 4 <= in.owned_count; i += 4) {
    const __m256d a = load_vertex(in, in.owned[i]), b = load_vertex(in, in.owned[i + 1]);
    const __m256d c = load_vertex(in, in.owned[i + 2]), d = load_vertex(in, in.owned[i + 3]);
    lower = _mm256_min_pd(lower, _mm256_min_pd(_mm256_min_pd(a, b), _mm256_min_pd(c, d)));
    upper = _mm256_max_pd(upper, _mm256_max_pd(_mm256_max_pd(a, b), _mm256_max_pd(c, d)));
    const __m256d xz02 = _mm256_unpacklo_pd(a, b), y02 = _mm256_unpackhi_pd(a, b);
    const __m256d xz13 = _mm256_unpacklo_pd(c, d), y13 = _mm256_unpackhi_pd(c, d);
    changed |= replace(in.x + i, _mm256_permute2f128_pd(xz02, xz13, 0x20));
    changed |= replace(in.y + i, _mm256_permute2f128_pd(y02, y13, 0x20));
    changed |= replace(in.z + i, _mm256_permute2f128_pd(xz02, xz13, 0x31));
  }
  for (; i < in.owned_count; ++i) {
    const double* p = in.source + 3 * static_cast<std::int64_t>(in.owned[i]);
    changed |= static_cast<unsigned>(in.x[i] != p[0]) | static_cast<unsigned>(in.y[i] != p[1]) |
               static_cast<unsigned>(in.z[i] != p[2]);
    in.x[i] = p[0];
    in.y[i] = p[1];
    in.z[i] = p[2];
    const __m256d v = load_vertex(in, in.owned[i]);
    lower = _mm256_min_pd(lower, v);
    upper = _mm256_max_pd(upper, v);
  }
  for (int k = 0; k < in.borrowed_count; ++k) {
    const __m256d v = load_vertex(in, in.borrowed[k]);
    lower = _mm256_min_pd(lower, v);
    upper = _mm256_max_pd(upper, v);
  }
  // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
  double low[4], high[4];
  _mm256_storeu_pd(low, _mm256_add_pd(lower, _mm256_setzero_pd()));
  _mm256_storeu_pd(high, _mm256_add_pd(upper, _mm256_setzero_pd()));
  for (int axis = 0; axis < 3; ++axis) {
    box->lower[axis] = low[axis];
    box->upper[axis] = high[axis];
  }
  return changed != 0;
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
const Kernels TACT_KERNELS = {TACT_KERNELS_NAME, find_large, refresh_cluster, select_heights, max_height,
                              select_overlapping, fill_facet_block, cull_facets, select_meeting};

}  // namespace tact::narrowphase

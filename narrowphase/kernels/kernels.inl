// The loops of kernels.h over the packs that the including file defines: over points and boxes here, over the bytes of a
// cluster and the cells of boxes in bytes.inl, over facets in facets.inl, over pairs of them in pair_lanes.inl,
// clear_pairs.inl, exact_pairs.inl, facet_pairs.inl and sort.inl, over moving polygons in motion.inl, over the caller's positions in refresh.inl. A tail of
// fewer than kWidth elements is read from a padded array where the caller promises padding (points, boxes: see
// ClusteredMesh) and its lanes are masked off.

namespace tact::narrowphase {
namespace {

static_assert(__FLT_EVAL_METHOD__ == 0, "an operation in double has to be rounded to double");

// Packs and masks of doubles or floats.
template <class Real>
struct Lanes {
  using Packed = Pack;
  using Masked = Mask;
  static constexpr int kCount = kWidth;
};
template <>
struct Lanes<float> {
  using Packed = FloatPack;
  using Masked = FloatMask;
  static constexpr int kCount = kFloatWidth;
};
template <class Real>
using PackOf = typename Lanes<Real>::Packed;
template <class Real>
using MaskOf = typename Lanes<Real>::Masked;

constexpr unsigned kAllLanes = (1u << kWidth) - 1u;
constexpr unsigned kAllFloatLanes = (1u << kFloatWidth) - 1u;

template <int kLanes = kWidth>
inline unsigned lanes_left(int left) {
  return left >= kLanes ? (1u << kLanes) - 1u : (1u << left) - 1u;
}

inline int append(unsigned mask, int first, std::int32_t* indices, int found) {
  while (mask != 0) {
    indices[found++] = first + __builtin_ctz(mask);
    mask &= mask - 1;
  }
  return found;
}

template <class AnyMask>
inline AnyMask without(AnyMask a, AnyMask b) {
  return differ(a, both(a, b));
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

// Calls work(i, heights) for the packs of points in some ranges. Lanes beyond the end of a range are lower than any
// point.
template <class Work>
inline void for_heights(PointArrays points, const IndexRange* ranges, int range_count, const HeightPack& height,
                        const Work& work) {
  for (const IndexRange* range = ranges; range != ranges + range_count; ++range) {
    for (int i = range->begin; i < range->end; i += kWidth) {
      Pack h = height(points, i);
      if (range->end - i < kWidth) h = select(mask_of(lanes_left(range->end - i)), h, spread(-__builtin_inf()));
      work(i, h);
    }
  }
}

// Each lane keeps the first and the last of its highest points; where these differ, all points are looked at again. A
// loop that leaves packs below `least` aside is faster where the same few reach it in every step, and slower in piles.
HighestPoint highest_point(PointArrays points, const std::int32_t* number, const IndexRange* ranges, int range_count,
                           const HeightAxis& axis, double least) {
  const HeightPack height(axis);
  Pack high = spread(-__builtin_inf()), first = spread(0.0), last = first;
  for_heights(points, ranges, range_count, height, [&](int i, Pack h) {
    const Pack here = spread(static_cast<double>(i));
    first = select(less(high, h), here, first);
    last = select(less_equal(high, h), here, last);
    high = max(high, h);
  });
  HighestPoint top{largest_lane(high), -1};
  if (!(top.height > -__builtin_inf() && top.height >= least)) return {-__builtin_inf(), -1};
  const Pack highest = spread(top.height);
  const auto precedes = [&](std::int32_t i, std::int32_t j) { return number ? number[i] < number[j] : i < j; };
  const auto take = [&](int begin, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::int32_t i = begin + __builtin_ctz(lanes);
      if (top.index < 0 || precedes(i, top.index)) top.index = i;
    }
  };
  const Mask as_high = less_equal(highest, high);
  if (bits(both(as_high, not_equal(first, last))) != 0) {
    for_heights(points, ranges, range_count, height, [&](int i, Pack h) { take(i, bits(less_equal(highest, h))); });
  } else {
    alignas(64) double first_of[kWidth];
    store(first_of, first);
    for (unsigned left = bits(as_high); left != 0; left &= left - 1)
      take(static_cast<int>(first_of[__builtin_ctz(left)]), left & -left);
  }
  top.height += 0.0;  // one zero: which of the two comes first depends on the order
  return top;
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

// The box of some lanes of boxes.
struct LaneBoxes {
  Pack lower[3], opposite_upper[3];

  LaneBoxes() {
    for (int axis = 0; axis < 3; ++axis) lower[axis] = opposite_upper[axis] = spread(__builtin_inf());
  }
  void widen(const BoxPointers& boxes, int i, Mask lanes) {
    const Pack infinite = spread(__builtin_inf()), zero = spread(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const Pack low = load(boxes.lower[axis] + i), opposite_high = sub(zero, load(boxes.upper[axis] + i));
      lower[axis] = min(lower[axis], select(lanes, low, infinite));
      opposite_upper[axis] = min(opposite_upper[axis], select(lanes, opposite_high, infinite));
    }
  }
  BoxBounds all() const {
    BoxBounds box;
    for (int axis = 0; axis < 3; ++axis) {
      // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
      box.lower[axis] = -largest_lane(sub(spread(0.0), lower[axis])) + 0.0;
      box.upper[axis] = largest_lane(sub(spread(0.0), opposite_upper[axis])) + 0.0;
    }
    return box;
  }
};

BoxBounds bounds(const BoxPointers& boxes, int count) {
  LaneBoxes lanes;
  for (int i = 0; i < count; i += kWidth) lanes.widen(boxes, i, mask_of(lanes_left(count - i)));
  return lanes.all();
}

DiagonalBounds diagonal_bounds(PointArrays points, int count) {
  Pack lower[kDiagonals], upper[kDiagonals];
  for (int k = 0; k < kDiagonals; ++k) {
    lower[k] = spread(__builtin_inf());
    upper[k] = spread(-__builtin_inf());
  }
  for (int i = 0; i < count; i += kWidth) {
    Pack x = load(points.x + i), y = load(points.y + i), z = load(points.z + i);
    if (count - i < kWidth) {
      const Mask points_left = mask_of(lanes_left(count - i));
      x = select(points_left, x, spread(points.x[0]));
      y = select(points_left, y, spread(points.y[0]));
      z = select(points_left, z, spread(points.z[0]));
    }
    const Pack reach[kDiagonals] = {add(y, z), add(z, x), add(x, y), sub(y, z), sub(z, x), sub(x, y)};
    for (int k = 0; k < kDiagonals; ++k) {
      lower[k] = min(lower[k], reach[k]);
      upper[k] = max(upper[k], reach[k]);
    }
  }
  DiagonalBounds all;
  for (int k = 0; k < kDiagonals; ++k) {
    // Adding zero turns -0 into +0: which of the two a minimum picks depends on the order.
    all.lower[k] = -largest_lane(sub(spread(0.0), lower[k])) + 0.0;
    all.upper[k] = largest_lane(upper[k]) + 0.0;
  }
  return all;
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

Culled cull_boxes(const BoxPointers& boxes, int count, const CullPlanes& planes, std::int32_t* indices) {
  const BoxPack box(planes.box);
  const HeightPack height(planes.axis);
  const Pack lowest = spread(planes.lowest);
  const auto far_corner = [&](double n, int axis) { return n >= 0.0 ? boxes.upper[axis] : boxes.lower[axis]; };
  const PointArrays far_corners{far_corner(planes.axis.nx, 0), far_corner(planes.axis.ny, 1),
                                far_corner(planes.axis.nz, 2)};
  Culled culled{0, 0};
  for (int i = 0; i < count; i += kWidth) {
    const unsigned meeting = box.overlap(boxes.lower, boxes.upper, i) & lanes_left(count - i);
    const unsigned low = meeting & bits(less(height(far_corners, i), lowest));
    culled.left = append(meeting & ~low, i, indices, culled.left);
    culled.low += __builtin_popcount(low);
  }
  return culled;
}

#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/pair_lanes.inl"
#include "narrowphase/kernels/clear_pairs.inl"
#include "narrowphase/kernels/exact_pairs.inl"
#include "narrowphase/kernels/facet_pairs.inl"
#include "narrowphase/kernels/motion.inl"
#include "narrowphase/kernels/refresh.inl"
#include "narrowphase/kernels/sort.inl"

}  // namespace

extern const Kernels TACT_KERNELS;
const Kernels TACT_KERNELS = {TACT_KERNELS_NAME, refresh_clusters, bounds, diagonal_bounds, select_heights,
                              highest_point, select_overlapping, cull_boxes, open_cluster, find_cells, facing_away,
                              near_facets, cells_of, any_near, share_cells, leave_aside, list_pairs, sort_pairs,
                              on_lattice, float_corners, match_float_pairs, match_exact_pairs,
                              match_exact_float_pairs, match_pairs, sharing_pairs, match_pairs_wide,
                              match_flat_pairs, apart_throughout};

}  // namespace tact::narrowphase

// Clusters of two surfaces that lie on each other, in floats about a point near them.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/pair_lanes.inl"

namespace tact::narrowphase {
namespace {

// Elements of an array of up to 192 floats. Up to 64 are taken whole into registers, where there are any.
struct AnyFloatPicks {
  const std::uint8_t* place;
  explicit AnyFloatPicks(const std::uint8_t* p) : place(p) {}
  FloatPack pick(const float* p, int count) const {
    if (count <= 64) return narrowphase::pick(p, count, FloatPicks(place));
    alignas(64) float picked[kFloatWidth];
    for (int i = 0; i < kFloatWidth; ++i) picked[i] = p[place[i]];
    return load(picked);
  }
};

// Fills an array up to a whole number of runs.
inline void repeat_first(float* p, int count) {
  for (int i = count; i % LocalVertices::kRun != 0; ++i) p[i] = p[0];
}

void localize(const ClusterFacets& in, const double* origin, double scale, const LocalVertices& out) {
  const double* const from[3] = {in.points.x, in.points.y, in.points.z};
  float* const to[3] = {out.x, out.y, out.z};
  for (int axis = 0; axis < 3; ++axis) {
    const Pack o = spread(origin[axis]), s = spread(scale);
    for (int i = 0; i < in.owned_count; i += kWidth)
      store(to[axis] + i, mul(sub(load(from[axis] + in.owned_begin + i), o), s));
    float* const borrowed = to[axis] + in.owned_count;
    const auto copy_pack = [&](int i) { store(borrowed + i, mul(sub(gather(from[axis], in.borrowed + i), o), s)); };
    int i = 0;
    for (; i + kWidth <= in.borrowed_count; i += kWidth) copy_pack(i);
    if (i < in.borrowed_count && in.borrowed_count >= kWidth) {
      copy_pack(in.borrowed_count - kWidth);  // some for a second time
    } else {
      for (; i < in.borrowed_count; ++i)
        borrowed[i] = static_cast<float>((from[axis][in.borrowed[i]] - origin[axis]) * scale);
    }
    repeat_first(to[axis], in.owned_count + in.borrowed_count);
  }
}

// Adds up sixteen numbers in one order, whatever the width.
inline float sum_of_sixteen(const float* p) {
  float eight[8], four[4];
  for (int i = 0; i < 8; ++i) eight[i] = p[i] + p[i + 8];
  for (int i = 0; i < 4; ++i) four[i] = eight[i] + eight[i + 4];
  return (four[0] + four[2]) + (four[1] + four[3]);
}

void mean_normal(const LocalVertices& v, const ClusterFacets& in, float* normal) {
  constexpr std::uint64_t kEveryFourth = 0x1111111111111111;
  const std::uint64_t sample = kEveryFourth & (~std::uint64_t{0} >> (64 - in.facet_count));
  alignas(64) std::uint8_t corner[3][128] = {};
  for (int k = 0; k < 3; ++k) compress(sample, in.corner[k], corner[k]);
  const int count = __builtin_popcountll(sample), vertices = in.owned_count + in.borrowed_count;
  alignas(64) float sums[3][16];
  for (int i = 0; i < 16; i += kFloatWidth) {
    VectorOf<float> p[3];
    for (int k = 0; k < 3; ++k) {
      const AnyFloatPicks at(corner[k] + i);
      p[k] = {at.pick(v.x, vertices), at.pick(v.y, vertices), at.pick(v.z, vertices)};
    }
    const ClearPlane<float> plane(p[0], p[1], p[2]);
    store_floats(sums[0] + i, plane.normal.x);
    store_floats(sums[1] + i, plane.normal.y);
    store_floats(sums[2] + i, plane.normal.z);
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = count; i < 16; ++i) sums[axis][i] = 0.0f;
    normal[axis] = sum_of_sixteen(sums[axis]);
  }
}

inline FloatPack along(const LocalVertices& v, int i, const FloatPack (&n)[3]) {
  return add(add(mul(n[0], load(v.x + i)), mul(n[1], load(v.y + i))), mul(n[2], load(v.z + i)));
}

LocalRange range_along(const LocalVertices& v, int count, const float* n) {
  const FloatPack axis[3] = {spread(n[0]), spread(n[1]), spread(n[2])};
  FloatPack lower = along(v, 0, axis), upper = lower;
  for (int i = kFloatWidth; i < count; i += kFloatWidth) {
    const FloatPack height = along(v, i, axis);
    lower = min(lower, height);
    upper = max(upper, height);
  }
  return {-largest_lane(sub(spread(0.0f), lower)) + 0.0f, largest_lane(upper) + 0.0f};
}

// Which cells the boxes of facets reach along one axis: numbers, before what follows the point is dropped.
struct CellsAlong {
  FloatPack margin, origin, scale;

  CellsAlong(const LocalFrame& frame, int axis)
      : margin(spread(frame.margin)), origin(spread(frame.cell_origin[axis])), scale(spread(frame.cell_scale[axis])) {}
  FloatPack cell(FloatPack x) const {
    return max(min(mul(sub(x, origin), scale), spread(static_cast<float>(kLastCell))), spread(0.0f));
  }
  FloatPack first(FloatPack lower) const { return cell(sub(lower, margin)); }
  FloatPack last(FloatPack upper) const { return cell(add(upper, margin)); }
};

// Leaving out packs without a near facet, axis by axis, takes 1.7 times as long: whether there is one is not foreseen.
std::uint64_t place_facets(const LocalVertices& v, const ClusterFacets& in, const LocalFrame& frame,
                           const CellBox& reached, FloatCorners* corners, FacetCells* cells) {
  alignas(64) float placed[LocalVertices::kMost];
  alignas(64) std::uint8_t corner[3][64] = {};
  const int vertices = in.owned_count + in.borrowed_count;
  for (int k = 0; k < 3; ++k) __builtin_memcpy(corner[k], in.corner[k], static_cast<std::size_t>(in.facet_count));
  std::uint64_t near = ~std::uint64_t{0} >> (64 - in.facet_count);
  for (int axis = 0; axis < 3; ++axis) {
    const FloatPack n[3] = {spread(frame.axis[axis][0]), spread(frame.axis[axis][1]), spread(frame.axis[axis][2])};
    const FloatPack offset = spread(frame.offset[axis]);
    for (int i = 0; i < vertices; i += kFloatWidth) store_floats(placed + i, add(along(v, i, n), offset));
    const CellsAlong cells_along(frame, axis);
    const FloatPack beyond = spread(static_cast<float>(reached.upper[axis] + 1));
    const FloatPack least = spread(static_cast<float>(reached.lower[axis]));
    FloatPack extent = spread(0.0f);
    std::uint64_t near_along = 0;
    for (int i = 0; i < in.facet_count; i += kFloatWidth) {
      FloatPack p[3];
      for (int k = 0; k < 3; ++k) {
        p[k] = AnyFloatPicks(corner[k] + i).pick(placed, vertices);
        store_floats(corners->corner[k][axis] + i, p[k]);
      }
      const FloatPack lower = min(min(p[0], p[1]), p[2]), upper = max(max(p[0], p[1]), p[2]);
      const FloatPack first = cells_along.first(lower), last = cells_along.last(upper);
      extent = max(extent, sub(upper, lower));
      store_cells(cells->lower[axis] + i, first);
      store_cells(cells->upper[axis] + i, last);
      near_along |= static_cast<std::uint64_t>(bits(both(less(first, beyond), less_equal(least, last)))) << i;
    }
    near &= near_along;
    corners->extent[axis] = static_cast<double>(largest_lane(extent));
  }
  corners->count = in.facet_count;
  corners->error = frame.error;
  cells->count = in.facet_count;
  return near;
}

}  // namespace
}  // namespace tact::narrowphase

// The loops over lines that are asked together: which boxes of a mesh each enters, which is next, which facets it may
// meet. Lines do not wait for each other: what one of them needs last is computed while the next begins.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"
#include "narrowphase/kernels/surfaces.inl"

namespace tact::narrowphase {
namespace {

void line_up_facets(const ClusterFacets& cluster, LinedFacets* lined) {
  constexpr int kRoom = LocalVertices::kMost + 64;
  alignas(64) float at[3][kRoom];
  localize(cluster, lined->origin, lined->scale, {at[0], at[1], at[2]});
  const int vertices = cluster.owned_count + cluster.borrowed_count;
  for (int k = 0; k < 3; ++k) {
    alignas(64) std::uint8_t place[LinedFacets::kMost] = {};
    __builtin_memcpy(place, cluster.corner[k], static_cast<std::size_t>(cluster.facet_count));
    for (int i = 0; i < LinedFacets::kMost; i += kFloatWidth) {
      const AnyFloatPicks picks(place + i);
      for (int axis = 0; axis < 3; ++axis) store_floats(lined->corner[k][axis] + i, picks.pick(at[axis], vertices));
    }
  }
  lined->count = cluster.facet_count;
}

inline double size_of(double x) { return x < 0.0 ? -x : x; }
inline double larger(double x, double y) { return x < y ? y : x; }

// Seen along the line, which is at zero, a corner is at (u, v). With e = 2^-24 coordinates of facets are rounded by e,
// slopes by e, where the line is by c e, of which c is the size, what a fused operation gives by 2 e, and the last
// difference by (2 + c) e: u and v are wrong by (6 + 2 c) e, and by what doubles lost from the beginning of the line
// on. Twice an area between the line and a side is wrong by that error times four coordinates of at most 2 + c, its
// square twice, and two roundings of at most 2 (2 + c)², which is less than another three. If the areas have both signs
// for certain, the line passes outside.
std::uint64_t facets_on_line(const LinedFacets& facets, const LineOfSight& line) {
  double away[3];  // of the middle of the facets from the line's beginning, in its order of axes
  for (int k = 0; k < 3; ++k) away[k] = (facets.origin[line.axis[k]] - line.from[line.axis[k]]) * facets.scale;
  const double farthest = larger(larger(size_of(away[0]), size_of(away[1])), size_of(away[2]));
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - facets.count);
  if (!(farthest < 0x1p100)) return all;
  const double at_u = away[0] - line.slope[0] * away[2], at_v = away[1] - line.slope[1] * away[2];
  const double size = larger(size_of(at_u), size_of(at_v)), lost = 0x1p-48 * farthest;
  if (size > 3.0 + lost) return 0;
  const double error = 0x1p-24 * (8.0 + 2.0 * size) + lost;
  const double bound = 1.001 * (8.0 * error * (2.0 + size + error));
  const FloatPack high = spread(static_cast<float>(bound)), low = spread(static_cast<float>(-bound));
  const FloatPack slope_u = spread(static_cast<float>(-line.slope[0])),
                  slope_v = spread(static_cast<float>(-line.slope[1]));
  const FloatPack from_u = spread(static_cast<float>(at_u)), from_v = spread(static_cast<float>(at_v));
  const int u_axis = line.axis[0], v_axis = line.axis[1], z_axis = line.axis[2];
  std::uint64_t out = 0;
  for (int i = 0; i < facets.count; i += kFloatWidth) {
    FloatPack u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      const FloatPack z = load(facets.corner[k][z_axis] + i);
      u[k] = add(fused_sum(slope_u, z, load(facets.corner[k][u_axis] + i)), from_u);
      v[k] = add(fused_sum(slope_v, z, load(facets.corner[k][v_axis] + i)), from_v);
    }
    const auto area = [&](int p, int q) { return fused(u[p], v[q], mul(u[q], v[p])); };
    const FloatPack a = area(1, 2), b = area(2, 0), c = area(0, 1);
    const FloatMask outside = both(less(min(min(a, b), c), low), less(high, max(max(a, b), c)));
    out |= static_cast<std::uint64_t>(bits(outside)) << i;
  }
  return all & ~out;
}

void enter_lined_boxes(const LinedBoxes& boxes, int first, int count, std::int32_t mark, EnteringLine* line) {
  const float *near[3], *far[3];
  FloatPack inverse[3], enter_at[3], leave_at[3];
  for (int axis = 0; axis < 3; ++axis) {
    const bool forward = line->inverse[axis] >= 0.0f;
    near[axis] = boxes.bounds[forward ? axis : axis + 3] + first;
    far[axis] = boxes.bounds[forward ? axis + 3 : axis] + first;
    inverse[axis] = spread(line->inverse[axis]);
    enter_at[axis] = spread(line->enter_at[axis]);
    leave_at[axis] = spread(line->leave_at[axis]);
  }
  const FloatPack begin = spread(0.0f), end = spread(line->latest);
  int found = line->count;
  for (int i = 0; i < count; i += kFloatWidth) {
    FloatPack enter = begin, leave = end;
    for (int axis = 0; axis < 3; ++axis) {
      enter = max(enter, fused(load(near[axis] + i), inverse[axis], enter_at[axis]));
      leave = min(leave, fused(load(far[axis] + i), inverse[axis], leave_at[axis]));
    }
    if (found > EnteringLine::kMost) {
      line->overflows = true;
      return;
    }
    const unsigned entered = bits(less_equal(enter, leave)) & lanes_left<kFloatWidth>(count - i);
    found += store_some_floats(entered, enter, first + i, mark, line->rank + found, line->index + found);
  }
  line->count = found;
  store_floats(line->rank + found, spread(__builtin_inff()));
}

// Takes out the least: its place in the list is the last one then. What follows the last is infinite.
bool take_nearest(EnteringLine* line) {
  if (line->count == 0) return false;
  FloatPack least = spread(__builtin_inff());
  for (int i = 0; i < line->count; i += kFloatWidth) least = min(least, load(line->rank + i));
  const float value = -largest_lane(sub(spread(0.0f), least));
  if (!(value <= line->latest)) return false;
  const FloatPack sought = spread(value);
  int at = 0;
  for (int i = 0;; i += kFloatWidth) {
    const unsigned same = bits(less_equal(load(line->rank + i), sought));
    if (same == 0) continue;
    at = i + __builtin_ctz(same);
    break;
  }
  const int last = --line->count;
  line->taken = line->index[at];
  line->rank[at] = line->rank[last];
  line->index[at] = line->index[last];
  line->rank[last] = __builtin_inff();
  return true;
}

}  // namespace
}  // namespace tact::narrowphase

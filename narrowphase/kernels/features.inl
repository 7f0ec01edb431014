// The loops over features that may be near each other: vertices, edges and facets.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/bytes.inl"
#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

void place_points(const ClusterFacets& in, double scale, const BoxBounds& box, ClusterPoints* points) {
  const double* const from[3] = {in.points.x, in.points.y, in.points.z};
  points->count = in.owned_count + in.borrowed_count;
  const Pack factor = spread(scale);
  for (int axis = 0; axis < 3; ++axis) {
    double* const to = points->at[axis];
    for (int i = 0; i < in.owned_count; i += kWidth) store(to + i, mul(factor, load(from[axis] + in.owned_begin + i)));
    for (int i = 0; i < in.borrowed_count; ++i) to[in.owned_count + i] = scale * from[axis][in.borrowed[i]];
  }
  const BoxPack sides(box);
  const Mask never = less(spread(1.0), spread(0.0));
  for (int i = 0; i < points->count; i += kWidth) {
    const Pack x = load(points->at[0] + i), y = load(points->at[1] + i), z = load(points->at[2] + i);
    const Mask out[7] = {less(x, sides.lower[0]), less(sides.upper[0], x), less(y, sides.lower[1]),
                         less(sides.upper[1], y), less(z, sides.lower[2]), less(sides.upper[2], z),
                         never};
    store_flags(points->outside + i, out);
  }
}

void place_features(const ClusterPoints& points, const FeatureCorners& in, const Grid& grid, double widen,
                    FeatureBlock* block) {
  block->count = block->cells.count = 0;
  if (in.count == 0) return;
  const std::uint8_t* const corner[3] = {in.corner[0], in.corner[in.corners > 1 ? 1 : 0], in.corner[in.corners - 1]};
  const std::uint64_t left = common_flags(points.outside, points.count, corner, in.count).none;
  const int count = __builtin_popcountll(left);
  write_places(left, block->feature);
  for (int k = 0; k < in.corners; ++k) {
    compress(left, in.corner[k], block->corner[k]);
    for (int n = count; n < count + kWidth; ++n) block->corner[k][n] = 0;
  }
  const Pack more = spread(widen);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < count; i += kWidth) {
      Pack low = gather(points.at[axis], block->corner[0] + i), high = low;
      for (int k = 1; k < in.corners; ++k) {
        const Pack x = gather(points.at[axis], block->corner[k] + i);
        low = min(low, x);
        high = max(high, x);
      }
      store_cells(block->cells.lower[axis] + i, cell(grid, axis, sub(low, more)));
      store_cells(block->cells.upper[axis] + i, cell(grid, axis, add(high, more)));
    }
  }
  block->count = block->cells.count = count;
}

struct QuadLanes {
  VectorPack point[4];
  QuadLanes(const PointQuads& in, int i) {
    for (int k = 0; k < 4; ++k) point[k] = {load(in.at[k][0] + i), load(in.at[k][1] + i), load(in.at[k][2] + i)};
  }
};

// A facet is beyond the reach if all its corners are, seen along one direction: its normal, or across a side of it.
// A direction is what its doubles say. Corners, counted from the vertex, are at most 7 long, so their products with it
// are wrong by less than 2^-46 times its length, and the squares of both by less than 2^-40 of themselves.
struct FacetBeyond {
  VectorPack corner[3];
  Pack reach_squared;

  Mask along(const VectorPack& direction) const {
    const Pack x = dot(direction, corner[0]), y = dot(direction, corner[1]), z = dot(direction, corner[2]);
    const Pack low = min(min(x, y), z), opposite_high = sub(spread(0.0), max(max(x, y), z));
    const Pack nearest = max(low, opposite_high);  // not positive if the corners are on both sides
    const Pack bound = mul(reach_squared, dot(direction, direction));
    return both(less(spread(0.0), nearest), less(bound, mul(nearest, nearest)));
  }
};

std::uint64_t facets_beyond(const PointQuads& quads, double reach) {
  const double most = reach * (1.0 + 0x1p-40) + 0x1p-46;
  const Pack reach_squared = spread(most * most * (1.0 + 0x1p-40));
  std::uint64_t beyond = 0;
  for (int i = 0; i < quads.count; i += kWidth) {
    const QuadLanes q(quads, i);
    const FacetBeyond facet{{sub(q.point[1], q.point[0]), sub(q.point[2], q.point[0]), sub(q.point[3], q.point[0])},
                            reach_squared};
    const VectorPack side[3] = {sub(facet.corner[1], facet.corner[0]), sub(facet.corner[2], facet.corner[1]),
                                sub(facet.corner[0], facet.corner[2])};
    const VectorPack normal = cross(side[0], side[1]);
    Mask some = facet.along(normal);
    for (const VectorPack& one : side) some = either(some, facet.along(cross(normal, one)));
    beyond |= static_cast<std::uint64_t>(bits(some) & lanes_left(quads.count - i)) << i;
  }
  return beyond;
}

// The same operations in the same order as LinePair in contact_points/nearest.cpp, so that both see the same places;
// the distance has room for another rounding.
std::uint64_t edges_beyond(const PointQuads& quads, double reach) {
  const Pack reach_squared = spread(reach * reach * (1.0 + 0x1p-40)), zero = spread(0.0);
  std::uint64_t beyond = 0;
  for (int i = 0; i < quads.count; i += kWidth) {
    const QuadLanes q(quads, i);
    const VectorPack u = sub(q.point[1], q.point[0]), w = sub(q.point[3], q.point[2]), r = sub(q.point[2], q.point[0]);
    const VectorPack across = cross(u, w);
    const Pack s = dot(cross(r, w), across), t = dot(cross(r, u), across), square = dot(across, across);
    const Pack height = dot(across, r);
    const Mask clear = less(mul(mul(spread(kNearlyParallel), dot(u, u)), dot(w, w)), square);
    const Mask beside = either(either(less_equal(s, zero), less_equal(square, s)),
                               either(less_equal(t, zero), less_equal(square, t)));
    const Mask far = less(mul(reach_squared, square), mul(height, height));
    beyond |= static_cast<std::uint64_t>(bits(both(clear, either(beside, far))) & lanes_left(quads.count - i)) << i;
  }
  return beyond;
}

}  // namespace
}  // namespace tact::narrowphase

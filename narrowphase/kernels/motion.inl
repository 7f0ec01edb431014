// The filter of moving polygons: a vertex and a facet, or two edges, whose corners move straight,
// see motion/meeting.h for what is proved there of each. Here the same certificates are tried for the whole step
// and a few directions, which leaves out nearly all.
//
// With u = 2^-53, the corners are wrong by u times their size (one difference each), and are at most `size` along an
// axis. A direction is what its doubles say, however it was computed; so its product with a corner is wrong by at most
// 5 u times its length (the sum of its sizes) times `size`: kRounding leaves room for ten times that, and for what it
// takes itself. Products below the smallest double lose less than kVanishing.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/facets.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

constexpr double kRounding = 0x1p-47;
constexpr double kVanishing = 1e-250;
// With sides of at most e and f along each axis, wrong by 3 u size, their cross product is wrong by 6 u size (e + f) +
// 4 u ef, its product with a corner by 18 u size² (e + f) + 42 u size ef, sums of three such by no more: less than this
// times size (size (e + f) + ef).
constexpr double kVolumeRounding = 0x1p-46;

inline VectorPack add(const VectorPack& a, const VectorPack& b) {
  return {add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)};
}
inline Pack size_of(const VectorPack& a) { return max(max(abs(a.x), abs(a.y)), abs(a.z)); }
inline Pack length_bound(const VectorPack& a) { return add(add(abs(a.x), abs(a.y)), abs(a.z)); }

template <int kCorners>
struct PolygonLanes {
  VectorPack corner[2][kCorners];
  Pack least;  // what a corner has to exceed along a direction of length 1

  PolygonLanes(const MovingPolygons& in, int i, const PolygonReach& reach) {
    Pack size = spread(0.0);
    for (int time = 0; time < 2; ++time) {
      for (int c = 0; c < kCorners; ++c) {
        const auto& from = in.corner[time][c];
        corner[time][c] = {load(from[0] + i), load(from[1] + i), load(from[2] + i)};
        size = max(size, size_of(corner[time][c]));
      }
    }
    size_ = size;
    reach_ = spread(reach.wider + reach.reach);
    if (reach.reach > 0.0) reach_ = allowed_reach(reach);
    least = add(reach_, mul(size, spread(kRounding)));
  }

  // Lanes in which all corners stay on one side.
  Mask apart_along(const VectorPack& direction) const {
    Pack low = dot(direction, corner[0][0]), high = low;
    for (int k = 1; k < 2 * kCorners; ++k) {
      const Pack x = dot(direction, corner[k / kCorners][k % kCorners]);
      low = min(low, x);
      high = max(high, x);
    }
    return is_outside(low, high, add(mul(length_bound(direction), least), spread(kVanishing)));
  }

  Mask apart_along_axes() const {
    Mask apart = less(spread(1.0), spread(0.0));
    const Pack bound = add(least, spread(kVanishing));
    constexpr Pack VectorPack::*kAxes[3] = {&VectorPack::x, &VectorPack::y, &VectorPack::z};
    for (const auto axis : kAxes) {
      Pack low = corner[0][0].*axis, high = low;
      for (int k = 1; k < 2 * kCorners; ++k) {
        const Pack x = corner[k / kCorners][k % kCorners].*axis;
        low = min(low, x);
        high = max(high, x);
      }
      apart = either(apart, is_outside(low, high, bound));
    }
    return apart;
  }

  // Lanes in which the volume that the corners span with the origin keeps its sign.
  Mask apart_by_volume() const {
    const VectorPack e0 = sub(corner[0][1], corner[0][0]), e1 = sub(corner[1][1], corner[1][0]);
    const VectorPack f0 = sub(corner[0][kCorners - 1], corner[0][0]), f1 = sub(corner[1][kCorners - 1], corner[1][0]);
    const VectorPack n0 = cross(e0, f0), n2 = cross(e1, f1),
                     n1 = add(cross(e0, f1), cross(e1, f0));  // twice the middle
    const VectorPack &d0 = corner[0][0], &d1 = corner[1][0];
    const Pack third = spread(1.0 / 3.0);
    const Pack v0 = dot(d0, n0), v3 = dot(d1, n2);
    const Pack v1 = mul(add(dot(d1, n0), dot(d0, n1)), third), v2 = mul(add(dot(d1, n1), dot(d0, n2)), third);
    const Pack low = min(min(v0, v1), min(v2, v3)), high = max(max(v0, v1), max(v2, v3));
    const Pack e = max(size_of(e0), size_of(e1)), f = max(size_of(f0), size_of(f1));
    const Pack rounding = mul(mul(size_, spread(kVolumeRounding)), add(mul(size_, add(e, f)), mul(e, f)));
    const Pack normal = max(max(length_bound(n0), length_bound(n2)), length_bound(n1));
    return is_outside(low, high,
                      add(add(mul(mul(reach_, spread(1.0 + 0x1p-40)), normal), rounding), spread(kVanishing)));
  }

 private:
  // Less in lanes in which a corner begins nearer than the reach.
  Pack allowed_reach(const PolygonReach& reach) const {
    Pack length = length_bound(corner[0][0]), squared = dot(corner[0][0], corner[0][0]);
    for (int c = 1; c < kCorners; ++c) {
      length = min(length, length_bound(corner[0][c]));
      squared = min(squared, dot(corner[0][c], corner[0][c]));
    }
    const Pack of_gap = add(mul(length, spread((1.0 + 0x1p-40) * reach.share_of_gap)), spread(reach.wider));
    return select(less(squared, spread((1.0 - 0x1p-40) * reach.reach * reach.reach)), min(of_gap, reach_), reach_);
  }

  static Mask is_outside(Pack low, Pack high, Pack bound) {
    return either(less(bound, low), less(high, sub(spread(0.0), bound)));
  }

  Pack size_, reach_;
};

template <int kCorners>
inline unsigned certainly_apart(const MovingPolygons& in, int i, const PolygonReach& reach) {
  const PolygonLanes<kCorners> polygon(in, i, reach);
  VectorPack middle[kCorners], begin = polygon.corner[0][0], end = polygon.corner[1][0];
  for (int c = 0; c < kCorners; ++c) {
    middle[c] = add(polygon.corner[0][c], polygon.corner[1][c]);
    if (c > 0) begin = add(begin, polygon.corner[0][c]), end = add(end, polygon.corner[1][c]);
  }
  Mask apart = either(polygon.apart_along_axes(), polygon.apart_by_volume());
  apart = either(apart, polygon.apart_along(add(begin, end)));
  // Across each side, in the plane of the polygon half-way, and along the way.
  const VectorPack way = sub(end, begin);
  const VectorPack normal = cross(sub(middle[1], middle[0]), sub(middle[kCorners - 1], middle[0]));
  constexpr int kSides = kCorners == 4 ? 2 : 3;  // those of a parallelogram are parallel
  for (int c = 0; c < kSides; ++c) {
    const VectorPack side = sub(middle[(c + 1) % kCorners], middle[c]);
    apart = either(apart, either(polygon.apart_along(cross(normal, side)), polygon.apart_along(cross(way, side))));
  }
  return bits(apart);
}

std::uint64_t apart_throughout(const MovingPolygons& polygons, const PolygonReach& reach) {
  std::uint64_t apart = 0;
  for (int i = 0; i < polygons.count; i += kWidth) {
    const unsigned some =
        polygons.corners == 3 ? certainly_apart<3>(polygons, i, reach) : certainly_apart<4>(polygons, i, reach);
    apart |= static_cast<std::uint64_t>(some & lanes_left(polygons.count - i)) << i;
  }
  return apart;
}

}  // namespace
}  // namespace tact::narrowphase

// The loop over pairs of a vertex and a facet: the twin of vertex_facet.cpp for many of them.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/features.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

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
    const Pack bound = add(mul(reach_squared, dot(direction, direction)), spread(kVanishing));
    return both(less(spread(0.0), nearest), less(bound, mul(nearest, nearest)));
  }
};

// The same operations in the same order as nearest_inside_facet(): what is certain here
// is certain there.
inline Mask beside_facet(const QuadLanes& q, const VectorPack& normal, double reach) {
  const Pack zero = spread(0.0), rounding_squared = spread(kSignRounding * kSignRounding);
  const Pack square = dot(normal, normal), height = dot(normal, sub(q.point[0], q.point[1]));
  const Pack most = mul(mul(spread(reach * reach), square), spread(1.0 + 0x1p-40));
  Mask beside = less(add(most, spread(kVanishing)), mul(height, height));
  for (int k = 0; k < 3; ++k) {
    const VectorPack& p = q.point[1 + (k + 1) % 3];
    const VectorPack along = sub(q.point[1 + (k + 2) % 3], p), away = sub(q.point[0], p),
                     across = sub(q.point[1 + k], p);
    const Pack length = dot(along, along);
    const Pack side = sub(mul(dot(away, across), length), mul(dot(across, along), dot(away, along)));
    const Pack size_squared = mul(mul(length, length), mul(dot(away, away), dot(across, across)));
    const Mask certain = less(mul(rounding_squared, size_squared), mul(side, side));
    beside = either(beside, both(certain, less(side, zero)));
  }
  return beside;
}

inline Mask beyond_facet(const QuadLanes& q, const VectorPack& normal, const VectorPack (&side)[3],
                         Pack reach_squared) {
  const FacetBeyond facet{{sub(q.point[1], q.point[0]), sub(q.point[2], q.point[0]), sub(q.point[3], q.point[0])},
                          reach_squared};
  Mask some = facet.along(normal);
  for (const VectorPack& one : side) some = either(some, facet.along(cross(normal, one)));
  return some;
}

std::uint64_t near_vertices(const PlacedFeatures& vertices, const PlacedFeatures& facets, double reach,
                            const std::uint64_t* left_out, std::uint64_t* near, std::uint64_t* inside) {
  const double most = reach * (1.0 + 0x1p-40) + 0x1p-46;
  const Pack reach_squared = spread(most * most * (1.0 + 0x1p-40));
  const std::uint64_t shared = for_listed_pairs<1, 3>(vertices, facets, left_out, near, [&](const auto& pairs, int i) {
    const QuadLanes q = pairs.lanes(vertices.points, facets.points, i);
    const VectorPack side[3] = {sub(q.point[2], q.point[1]), sub(q.point[3], q.point[1]), sub(q.point[3], q.point[2])};
    const VectorPack normal = cross(side[0], side[1]);
    unsigned left = ~bits(beyond_facet(q, normal, side, reach_squared)) & lanes_left(pairs.count - i);
    if (left == 0) return;
    const unsigned beside = bits(beside_facet(q, normal, reach));
    for (; left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left), vertex = pairs.few[i + lane];
      const std::uint64_t facet = std::uint64_t{1} << pairs.many[i + lane];
      if (near[vertex] == 0) inside[vertex] = 0;
      near[vertex] |= facet;
      if ((beside >> lane & 1) == 0) inside[vertex] |= facet;
    }
  });
  return with_any(shared, near);
}

}  // namespace
}  // namespace tact::narrowphase

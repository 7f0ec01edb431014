// The loops over pairs of edges: the twin of edge_edge.cpp for many of them.
#pragma once

#include <cstdint>

#include "narrowphase/kernels/features.inl"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/kernels/lanes.inl"

namespace tact::narrowphase {
namespace {

// The same operations in the same order as LinePair in edge_edge.cpp, so that both see the same places;
// the distance has room for another rounding. Edges that change places change signs at most.
struct EdgeLanes {
  VectorPack across;
  Pack square, height;
  Pack rounding_squared;  // of the height, times `square`
  Mask clear, beyond;

  EdgeLanes(const QuadLanes& q, Pack reach_squared) {
    const Pack zero = spread(0.0);
    const VectorPack u = sub(q.point[1], q.point[0]), w = sub(q.point[3], q.point[2]), r = sub(q.point[2], q.point[0]);
    across = cross(u, w);
    const Pack s = dot(cross(r, w), across), t = dot(cross(r, u), across);
    square = dot(across, across);
    height = dot(across, r);
    const Pack size_squared = mul(dot(u, u), dot(w, w));
    rounding_squared = mul(spread(kSignRounding * kSignRounding), mul(dot(r, r), size_squared));
    clear = both(less(spread(kVanishing), size_squared), less(mul(spread(kNearlyParallel), size_squared), square));
    const Mask beside =
        either(either(less_equal(s, zero), less_equal(square, s)), either(less_equal(t, zero), less_equal(square, t)));
    const Mask far = less(mul(reach_squared, square), mul(height, height));
    beyond = both(clear, either(beside, far));
  }

  // Lanes in which a facet certainly leads from `end` to `third` along the way, which is `across` times a sign. Twice
  // the bound there.
  Mask leads(Pack sign, const VectorPack& end, const VectorPack& third) const {
    const VectorPack to = sub(third, end);
    const Pack rise = mul(sign, dot(across, to));
    const Pack bound = mul(spread(4.0 * kSignRounding * kSignRounding), mul(square, dot(to, to)));
    return both(less(spread(0.0), rise), less(bound, mul(rise, rise)));
  }
};

inline Pack edge_reach_squared(double reach) { return spread(reach * reach * (1.0 + 0x1p-40)); }

std::uint64_t edges_beyond(const EdgePairs& pairs, const PointArrays& a, const PointArrays& b, double scale,
                           double reach, EdgeSide side) {
  const Pack reach_squared = edge_reach_squared(reach), unit = spread(scale);
  const Pack one = spread(1.0), opposite = spread(-1.0), zero = spread(0.0);
  std::uint64_t all = 0;
  for (int i = 0; i < pairs.count; i += kWidth) {
    const auto point = [&](int mesh, int k) {
      const PointArrays& at = mesh == 0 ? a : b;
      const std::int32_t* const vertex = pairs.vertex[mesh][k] + i;
      return VectorPack{mul(unit, gather(at.x, vertex)), mul(unit, gather(at.y, vertex)),
                        mul(unit, gather(at.z, vertex))};
    };
    const QuadLanes q{{point(0, 0), point(0, 1), point(1, 0), point(1, 1)}};
    const EdgeLanes edges(q, reach_squared);
    // Which way the point's normal goes along `across`. Of edges that touch, or nearly, doubles do not tell.
    const Mask below = less(edges.height, zero);
    const Pack sign = side == EdgeSide::before ? select(below, opposite, one) : select(below, one, opposite);
    const Pack back = sub(zero, sign);
    const Mask has_side = less(edges.rounding_squared, mul(edges.height, edges.height));
    const Mask leads =
        either(either(edges.leads(sign, q.point[0], point(0, 2)), edges.leads(sign, q.point[0], point(0, 3))),
               either(edges.leads(back, q.point[2], point(1, 2)), edges.leads(back, q.point[2], point(1, 3))));
    const Mask none = either(edges.beyond, both(both(edges.clear, has_side), leads));
    all |= static_cast<std::uint64_t>(bits(none) & lanes_left(pairs.count - i)) << i;
  }
  return all;
}

// Those pairs of edges that share cells, but for the lanes beyond_of(points).
template <class BeyondOf>
inline std::uint64_t edges_not_beyond(const PlacedFeatures& few, const PlacedFeatures& many,
                                      const std::uint64_t* left_out, std::uint64_t* near, const BeyondOf& beyond_of) {
  const std::uint64_t shared = for_listed_pairs<2, 2>(few, many, left_out, near, [&](const auto& pairs, int i) {
    const Mask beyond = beyond_of(pairs.lanes(few.points, many.points, i));
    for (unsigned left = ~bits(beyond) & lanes_left(pairs.count - i); left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      near[pairs.few[i + lane]] |= std::uint64_t{1} << pairs.many[i + lane];
    }
  });
  return with_any(shared, near);
}

std::uint64_t near_edges(const PlacedFeatures& few, const PlacedFeatures& many, double reach,
                         const std::uint64_t* left_out, std::uint64_t* near) {
  const Pack reach_squared = edge_reach_squared(reach);
  return edges_not_beyond(few, many, left_out, near,
                          [&](const QuadLanes& q) { return EdgeLanes(q, reach_squared).beyond; });
}

// The squared distance of a point from an edge through the origin: `to` leads there from the point.
inline Pack squared_from_edge(const VectorPack& to, const VectorPack& edge, Pack length) {
  const Pack part = max(spread(0.0), min(spread(1.0), div(sub(spread(0.0), dot(to, edge)), length)));
  const VectorPack way{add(to.x, mul(part, edge.x)), add(to.y, mul(part, edge.y)), add(to.z, mul(part, edge.z))};
  return dot(way, way);
}

// Edges are nearest inside both, or at an end of one. Beyond the reach is what is by more than 2^-32: points differ by
// at most 7, so that products of the first are wrong by less than 2^-47, and where lines are nearest, over a sine of at
// least 1e-4, by less than 2^-33. From inside nearly parallel edges it is less than 1e-4 times the shorter one farther
// to an end of one of them; (a + b)² is at most 2 a² + 2 b².
std::uint64_t close_edges(const PlacedFeatures& few, const PlacedFeatures& many, double reach,
                          const std::uint64_t* left_out, std::uint64_t* near) {
  const double most = reach * (1.0 + 0x1p-40) + 0x1p-32;
  const Pack reach_squared = spread(most * most), least_length = spread(kVanishing);
  return edges_not_beyond(few, many, left_out, near, [&](const QuadLanes& q) {
    const EdgeLanes edges(q, reach_squared);
    const VectorPack u = sub(q.point[1], q.point[0]), w = sub(q.point[3], q.point[2]);
    const Pack along_u = max(dot(u, u), least_length), along_w = max(dot(w, w), least_length);
    const Pack from_few = min(squared_from_edge(sub(q.point[2], q.point[0]), w, along_w),
                              squared_from_edge(sub(q.point[2], q.point[1]), w, along_w));
    const Pack from_many = min(squared_from_edge(sub(q.point[0], q.point[2]), u, along_u),
                               squared_from_edge(sub(q.point[0], q.point[3]), u, along_u));
    const Pack from_ends = min(from_few, from_many);
    const Pack turned = mul(spread(4.0 * kNearlyParallel), min(along_u, along_w));
    const Mask far = less(add(mul(spread(2.0), reach_squared), turned), from_ends);
    const Mask nearly_parallel = differ(edges.clear, less_equal(spread(0.0), spread(0.0)));
    return both(less(reach_squared, from_ends), either(edges.beyond, both(nearly_parallel, far)));
  });
}

}  // namespace
}  // namespace tact::narrowphase

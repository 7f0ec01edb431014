// The distance of a point from M, by Gilbert, Johnson and Keerthi: "A fast procedure for computing the distance between
// complex objects in three-dimensional space", 1988. With the point at the origin it is the distance of the hulls.
#pragma once

#include <array>

#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

enum class GjkStatus {
  apart,          ///< certainly: the lower bound of the distance exceeds all rounding
  touching,       ///< the point lies within rounding of a vertex, an edge or a triangle of vertices of M
  overlapping,    ///< the point lies inside a tetrahedron of vertices of M: certainly, if it is the origin
  limit_reached,  ///< none of these was shown: the result is the best found; no known input leads here
};

// Pairs of vertices that span the part of M nearest to the point: the start of the next search.
struct GjkSimplex {
  std::array<int, 4> a{};
  std::array<int, 4> b{};
  int count = 0;
};

struct GjkResult {
  GjkStatus status = GjkStatus::limit_reached;
  Vec3 offset;               ///< from the point to the nearest point of M, scaled; -offset separates the two
  double distance = 0.0;     ///< |offset|, scaled: an upper bound, but for rounding
  double lower_bound = 0.0;  ///< scaled: M is at least this far, but for rounding
  bool closed = false;       ///< the bounds are as close as GjkSettings says; `apart` is certain without that
  GjkSimplex simplex;        ///< the vertices of M around the nearest point
  /// Of up to three vertices of the simplex: their weighted sum is the nearest point. No weight is negative.
  std::array<double, 4> weight{};
  int support_queries = 0;
};

struct GjkSettings {
  double tolerance = 1e-12;  ///< stops where distance - lower_bound <= tolerance * distance + 16 roundoffs of M's size
  int query_limit = 1000;    ///< support queries; a guard that no known input reaches
};

// True if the origin is certainly strictly inside the tetrahedron of four vertices of M; then the hulls overlap. False
// for fewer than four.
bool holds_origin(const MinkowskiDifference& m, const GjkSimplex& simplex);

// The distance of `point` (scaled) from M. `start` may hold vertices from an earlier search, or nothing.
GjkResult gjk(const MinkowskiDifference& m, Vec3 point, const GjkSimplex& start, const GjkSettings& settings);

// A point of each hull, in metres. Their difference is the nearest point of M that a search found, or the origin if it
// ended `overlapping`. After a search for the origin between hulls that are apart, they are two closest points; where
// faces are parallel, others may be as close.
struct ClosestPoints {
  Vec3 a, b;
};
ClosestPoints closest_points(const MinkowskiDifference& m, const GjkResult& result);

}  // namespace tact::narrowphase

// The point of a small simplex nearest to the origin.
#pragma once

#include <array>

#include "engine/base/vec3.h"

namespace tact::narrowphase {

using base::Vec3;

// Up to four points.
struct SimplexPoints {
  std::array<Vec3, 4> point;
  int count = 0;
};

// The nearest point, on the smallest face that holds it.
struct SimplexClosest {
  Vec3 point;
  std::array<int, 4> carrier{};  // indices of the points that span the face, ascending
  int carrier_count = 0;         // 4: the origin lies inside the tetrahedron
  // Of up to three points of the carrier in `point`: none is negative, and they sum to 1 but for rounding.
  std::array<double, 4> weight{};
  // |point|², and what rounding took from it where the search computed in triple-doubles, else zero. For
  // comparisons.
  double distance_squared = 0.0;
  double distance_squared_tail = 0.0;

  bool is_nearer_than(const SimplexClosest& other) const {
    if (distance_squared != other.distance_squared) return distance_squared < other.distance_squared;
    return distance_squared_tail < other.distance_squared_tail;
  }
};

// The point of the simplex nearest to the origin. Points may coincide or lie on a line or in a plane. Every face is
// tried but those without extent; the nearest wins, of equals the one with fewer points. count >= 1.
SimplexClosest simplex_closest(const SimplexPoints& simplex);

// True if the origin certainly lies strictly inside the tetrahedron of four points, even if each coordinate of a point
// is off by a rounding. False where rounding could decide.
bool tetrahedron_holds_origin(const SimplexPoints& simplex);

// simplex_closest() in triple-doubles, some fifty times slower: for simplices so thin that doubles lose the point.
SimplexClosest simplex_closest_in_triple(const SimplexPoints& simplex);

// The weights of four points around the origin, from triple-doubles: the weighted sum of the points is the origin,
// but for rounding. Where the tetrahedron is too flat to tell, the weights of the nearest point of its faces.
std::array<double, 4> origin_weights(const SimplexPoints& simplex);

}  // namespace tact::narrowphase

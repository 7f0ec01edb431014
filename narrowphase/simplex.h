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
  // |point|², and what rounding took from it: twice the digits, where the search had them. For comparisons.
  double distance_squared = 0.0;
  double distance_squared_tail = 0.0;

  bool is_nearer_than(const SimplexClosest& other) const {
    if (distance_squared != other.distance_squared) return distance_squared < other.distance_squared;
    return distance_squared_tail < other.distance_squared_tail;
  }
};

// The point of the simplex nearest to the origin. Points may coincide or lie in a line or plane: every face is tried,
// those without extent are passed over, and the nearest wins (of equals the one with fewer points). count >= 1.
SimplexClosest simplex_closest(const SimplexPoints& simplex);

// Does the origin lie strictly inside the tetrahedron of four points, for certain? False where rounding could decide.
bool tetrahedron_holds_origin(const SimplexPoints& simplex);

// The same with numbers of twice the digits, some fifty times slower: for simplices so thin that doubles lose the
// point.
SimplexClosest simplex_closest_wide(const SimplexPoints& simplex);

}  // namespace tact::narrowphase

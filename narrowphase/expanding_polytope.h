// The smallest separation of two overlapping hulls: the face of M nearest to the origin, by an expanding polytope
// (van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", GDC 2001).
#pragma once

#include "narrowphase/minkowski_difference.h"

namespace tact::narrowphase {

struct SmallestSeparation {
  Vec3 direction;              // unit, from A to B
  double height = 0.0;         // w(direction), scaled; never below the true minimum by more than rounding
  double lower_bound = 0.0;    // scaled; the true minimum of w over all directions is at least this
  bool limit_reached = false;  // the bounds did not close: the direction is the best found
};

// The direction with the least w(n) over all unit n. M must hold the origin, or nearly; it may be flat, a segment or a
// point (height 0: a normal of it). `preferred` breaks ties between a direction and its opposite when M is flat.
SmallestSeparation smallest_separation(const MinkowskiDifference& m, Vec3 preferred);

}  // namespace tact::narrowphase

// The smallest separation of two overlapping hulls, exactly, whatever M is: the face of M nearest to the origin, by an
// expanding polytope (van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", GDC
// 2001).
#pragma once

#include <vector>

#include "narrowphase/depth/convex_polytope.h"
#include "narrowphase/depth/queried_directions.h"
#include "narrowphase/hull/gjk.h"
#include "narrowphase/hull/minkowski_difference.h"

namespace tact::narrowphase {

// A face that may be the nearest to the origin.
struct OpenFace {
  double distance;  // of its plane, or less
  int face;
  friend bool operator>(const OpenFace& p, const OpenFace& q) {
    return p.distance != q.distance ? p.distance > q.distance : p.face > q.face;
  }
};

// What a search uses; lent to the next one, which then allocates little or nothing.
struct PolytopeMemory {
  std::vector<MinkowskiVertex> seeds;
  std::vector<OpenFace> open;
  std::vector<Vec3> normals;  // of all faces
  QueriedDirections queried;
  ConvexPolytope polytope;
};

struct SmallestSeparation {
  Vec3 direction;            ///< unit, from A to B
  double height = 0.0;       ///< w(direction), scaled; above the least w by at most rounding, unless limit_reached
  double lower_bound = 0.0;  ///< of w over all directions, scaled, if M holds the origin
  GjkSimplex face = {};      ///< three vertices of M that probably span the face across the direction, or nothing
  int support_queries = 0;
  bool limit_reached = false;  ///< the bounds did not close: the direction is the best found
};

// The direction with the least w(n) over all unit n. M must hold the origin, but for rounding: the origin may lie on
// the border, or so little outside that w is negative by rounding. If M does not hold the origin, some direction with w
// < 0 is returned.
//
// Of the directions that the search met and that are equally low but for rounding, the one nearest to `preferred` (any
// vector, zero included) is returned. If M is flat or nearly so, the direction is its normal on the side of
// `preferred`; if it is a segment, the direction across it nearest to `preferred`; if it is a point, `preferred`.
//
// Each support query gives an upper bound of the minimum: w of its direction. The nearest face of the polytope gives a
// lower bound. The search ends when the bounds meet but for rounding. Round and concentric bodies have no nearest face
// until all of M is known: the number of queries grows with the faces of M, up to a limit that grows with the bodies'
// vertices.
SmallestSeparation expanding_polytope(const MinkowskiDifference& m, Vec3 preferred, PolytopeMemory& memory);

// For any search for the smallest height: `preferred` as a unit vector; the distance of the bounds, scaled, at which it
// ends; the most support queries that it makes.
Vec3 preferred_direction(Vec3 preferred);
double height_tolerance(const MinkowskiDifference& m);
int query_limit(const MinkowskiDifference& m);

}  // namespace tact::narrowphase

// A vertex and a facet, or two edges, whose vertices move straight.
//
// Both are one figure. Seen from the vertex, the corners of the facet are three points; seen from the points of one
// edge, those of the other fill a parallelogram. So a flat convex polygon of three or four corners moves, each of them
// straight; the two features share a point when it holds the origin.
#pragma once

#include "engine/base/vec3.h"
#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

using base::Vec3;

/// The corners at time 0 and at time 1, relative to the origin, metres, as exact differences of positions. Four are
/// those of a parallelogram, in the order of its outline. Corners that are one at both times stand once: of a facet or
/// an edge without extent one or two are left.
struct MovingPolygon {
  int count = 0;
  DoubleDoubleVec3 corner[2][4];
};

/// Positions at time 0 and at time 1.
struct MovingVertex {
  Vec3 at[2];
};

MovingPolygon facet_seen_from(const MovingVertex& vertex, const MovingVertex (&facet)[3]);
MovingPolygon edge_seen_from(const MovingVertex (&edge)[2], const MovingVertex (&other)[2]);

}  // namespace tact::narrowphase

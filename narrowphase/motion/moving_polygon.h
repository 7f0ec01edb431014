// A vertex and a facet, or two edges, whose vertices move straight.
//
// Both are one figure: the differences of their points form a flat convex polygon. For a vertex and a facet it has
// three corners; for two edges it is a parallelogram. Each corner moves straight. The two features share a point when
// the polygon holds the origin.
#pragma once

#include "engine/base/vec3.h"
#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

using base::Vec3;

/// The corners at time 0 and at time 1, in metres, as exact differences of positions. The four of a parallelogram stand
/// in the order of its outline. Corners that coincide at both times stand once: a facet or an edge without extent
/// leaves one or two.
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

// Where the border of a facet is nearest to a vertex: inside an edge, or in a vertex.
#pragma once

#include <optional>

#include "narrowphase/distance/nearest.h"

namespace tact::narrowphase {

/// The minimum of the distance from `v` inside the edge from `p` to `q`, if there is one nearer than `limit`; `third`
/// holds a third vertex for each facet that has the edge. A distance of zero has no direction: `normal` is then zero.
std::optional<Nearest> nearest_inside_edge(Vec3 v, Vec3 p, Vec3 q, const ScaledVertices& third, double limit);

/// That in the vertex `w`; `neighbors` are the other ends of its edges. `normal` is zero where the distance is.
std::optional<Nearest> nearest_in_vertex(Vec3 v, Vec3 w, const ScaledVertices& neighbors, double limit);

/// Where on a facet's border a vertex may be nearest, as far as the facet itself tells: most often nowhere. Bit k:
/// inside the edge from corner k to the next one; bit 3 + k: in corner k. A bit is missing only where
/// nearest_inside_edge() or nearest_in_vertex() certainly tell that there is no point nearer than `limit`, whatever
/// else is at that edge or vertex: the vertex is beside the edge's ends, on the facet's own side of it, or nearer to
/// another place of an edge of the corner.
unsigned border_of(Vec3 v, const Vec3 (&corner)[3], double limit);

}  // namespace tact::narrowphase

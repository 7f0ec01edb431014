// Where on a facet's border a vertex may be nearest, as far as the facet itself tells: most often nowhere.
#pragma once

#include "narrowphase/contact_points/nearest.h"

namespace tact::narrowphase {

/// Bit k: inside the edge from corner k to the next one; bit 3 + k: in corner k. A bit is missing only where
/// nearest_inside_edge() or nearest_in_vertex() certainly tell that there is no point nearer than `limit`, whatever
/// else is at that edge or vertex: the vertex is beside the edge's ends, on the facet's own side of it, or nearer to
/// another place of an edge of the corner.
unsigned border_of(Vec3 v, const Vec3 (&corner)[3], double limit);

}  // namespace tact::narrowphase

// Whether a contact point is a minimum of the distance of both surfaces: its normal lies in the normal cones of both
// features. The search gives each vertex its minima on the other surface, for that vertex alone; whether the vertex's
// own surface comes nearer beside it is told here. Between edges within the reach nothing comes nearer: nearest.h.
//
// Flat surfaces have cones of one direction, so a vertex or an inner edge of a flat floor has no other minimum than
// along the floor's normal.
#pragma once

#include "narrowphase/contact_points/feature_point.h"

namespace tact::narrowphase {

/// True if no edge of the point's vertex, or no facet at its edges, leads along the normal towards the other surface. A
/// slope of up to 2^-30, which meshes have that were turned and rounded, is level: so a box on a floor has a minimum in
/// each lower corner.
bool is_local_minimum(const FeaturePoint& point, const FeaturedMesh& a, const FeaturedMesh& b);

}  // namespace tact::narrowphase

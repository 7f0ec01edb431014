// Whether a surface is the border of a convex body.
#pragma once

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// Whether a closed surface in one piece bends outwards at each edge, or by no more than rounding inwards: then it is
/// convex (van Heijenoort, On locally convex manifolds, 1952). Takes time for each edge.
bool is_convex(const ScaledMesh& surface);

}  // namespace tact::narrowphase

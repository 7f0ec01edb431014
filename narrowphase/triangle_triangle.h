// Do two triangles meet? Closed sets, decided exactly; a triangle without area is the segment or the point that it is.
#pragma once

#include "narrowphase/clustered_mesh.h"
#include "narrowphase/predicates.h"

namespace tact::narrowphase {

// Do `a` and `b` share at least one point? The same for any order of corners and of arguments.
bool triangle_triangle_meet(const Triangle& a, const Triangle& b, PredicateCounts& counts);

}  // namespace tact::narrowphase

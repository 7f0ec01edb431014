// How far a point is from a facet: the exact distance, rounded once, so that equal ones are equal.
#pragma once

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The distance of a point from a triangle, which may be degenerate, rounded to the nearest double.
double rounded_distance(Vec3 point, const Triangle& triangle);

}  // namespace tact::narrowphase

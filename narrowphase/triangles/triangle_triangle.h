// Whether two triangles meet, as closed sets, decided exactly; a triangle without area is the segment or the point that
// it is.
//
// Only signs of determinants decide (predicates.h), so the domain and the accuracy are theirs: there is no epsilon, and
// no point is constructed. Every answer is the same for any order of corners and of arguments.
#pragma once

#include <array>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

// The two ends, which may be one point.
using Segment = std::array<Vec3, 2>;

// True if `a` and `b` share at least one point. After Guigue and Devillers, "Fast and Robust Triangle-Triangle Overlap
// Test Using Orientation Predicates", 2003: if all corners of one are strictly on one side of the other's plane, at
// most six orient3d tell; if the triangles cross each other's planes, two more.
bool triangle_triangle_meet(const Triangle& a, const Triangle& b, PredicateCounts& counts);

// The same where it is known that the corners of `a` lie in the plane of `b`, or that `b` has no area.
bool coplanar_triangles_meet(const Triangle& a, const Triangle& b, PredicateCounts& counts);

// Facets of one mesh that name `common` vertices, 1 to 3, both: these stand first in both triangles, in the same order.
// True if they share a point beyond what they have in common by that: the vertex, or the edge. They do where one runs
// through the other, where they are folded flat onto each other, and where all three corners are common, unless they
// have no area. A triangle without area that has the common edge shares no more with others that have it than the edge.
bool triangles_meet_beyond(const Triangle& a, const Triangle& b, int common, PredicateCounts& counts);

// True if `segment` and `triangle` share at least one point.
bool segment_triangle_meet(const Segment& segment, const Triangle& triangle, PredicateCounts& counts);

// True if `a` and `b` share at least one point.
bool segment_segment_meet(const Segment& a, const Segment& b, PredicateCounts& counts);

}  // namespace tact::narrowphase

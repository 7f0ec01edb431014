// The truth about triangles and orientations, from CGAL.
#pragma once

#include "narrowphase/numeric/predicates.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::tests {

using narrowphase::Point2;
using narrowphase::Triangle;
using narrowphase::Vec3;

// The signs of narrowphase::orient3d and orient2d, from rational numbers.
int rational_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int rational_orient2d(const Point2& a, const Point2& b, const Point2& c);

// Do the triangles share a point? CGAL's exact predicates decide; CGAL wants triangles with an area, so one without is
// given to it as the segment or the point that it is, with rational coordinates.
bool cgal_meet(const Triangle& a, const Triangle& b);
// The same with rational coordinates throughout: slower, and independent of CGAL's floating-point filters.
bool rational_meet(const Triangle& a, const Triangle& b);

// Whether no double is nearer to the distance of a point from a triangle than `distance`, in rational numbers.
bool is_nearest_to_distance(double distance, const Vec3& point, const Triangle& t);
// The same of the part of a segment at which it crosses the plane of a triangle.
bool is_nearest_to_time(double time, const Vec3& from, const Vec3& to, const Triangle& t);

// Do triangles whose first `common` corners, 1 to 3, are the same share more than these and the edge between two of
// them? By what CGAL constructs as their intersection, in rational coordinates. Where all three are common, they do if
// they have an area.
bool rational_meet_beyond(const Triangle& a, const Triangle& b, int common);

}  // namespace tact::tests

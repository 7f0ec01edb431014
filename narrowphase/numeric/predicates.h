// Exact signs of determinants of doubles: a floating-point filter, and integers where it cannot tell. There is no
// epsilon.
//
// Coordinates must be finite and at most 2^300 in size; subnormal ones are welcome. Then every sign is exact, in any
// rounding mode and with subnormal numbers flushed to zero or not.
#pragma once

#include <array>
#include <cstdint>

#include "engine/base/vec3.h"

namespace tact::narrowphase {

using base::Vec3;

// A point in a coordinate plane.
struct Point2 {
  double x = 0.0;
  double y = 0.0;
};

// How often the filter could not tell.
struct PredicateCounts {
  std::int64_t exact = 0;
};

// The sign of (a - d) · ((b - d) × (c - d)): +1 if d lies below the plane through a, b, c, where they appear
// counter-clockwise from above; -1 above; 0 in one plane.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, PredicateCounts& counts);

// orient3d(a, b, c, points[i]) for each i; the normal of the plane is computed once.
std::array<int, 3> sides_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<Vec3, 3>& points,
                                  PredicateCounts& counts);

// The sign of (a - c) × (b - c): +1 if a, b, c turn counter-clockwise, -1 clockwise, 0 on one line.
int orient2d(const Point2& a, const Point2& b, const Point2& c, PredicateCounts& counts);

// -1 if a comes before b in the order by x, then y, then z; +1 after; 0 if they are one point.
int compare_lexicographically(const Vec3& a, const Vec3& b);

}  // namespace tact::narrowphase

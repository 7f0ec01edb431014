// Where a segment first is in a triangle that it meets.
#pragma once

#include <array>
#include <cmath>

#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

/// A place of a segment and of a triangle.
struct CommonPlace {
  double time = 0.0;               // as a part of the segment, the exact one, rounded once
  std::array<double, 3> weight{};  // of the triangle's corners
};

/// The axis along which a vector is longest; of equal ones the first.
inline int longest_axis(Vec3 a) {
  const Vec3 size{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

/// The first place of a segment, which is no point, in a triangle that it meets. The time is the exact one, rounded
/// once: places that are one, of whichever triangles, have one time. The weights are right to 2^-50 of themselves, or
/// the place that they give to 2^-48 of the triangle's size.
CommonPlace first_place(const Segment& segment, const Triangle& triangle);

/// A place of a segment in a triangle.
struct PlaceOfSegment {
  double time = 0.0;  // as a part of the segment, the exact one, rounded once
  Vec3 position;      // each coordinate the exact one, rounded once; in the triangle's plane it is that of the time
};

/// The place of first_place().
PlaceOfSegment place_in_facet(const Segment& segment, const Triangle& triangle);

/// The time of first_place() alone; the segment does not lie in the triangle's plane.
double crossing_time(const Segment& segment, const Triangle& triangle);

}  // namespace tact::narrowphase

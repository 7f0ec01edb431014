// Where a segment first is in a triangle that it meets, from exact numbers rounded once.
#pragma once

#include <array>
#include <cmath>

#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

/// A place of a segment and of a triangle.
struct CommonPlace {
  double time = 0.0;               // as a part of the segment
  std::array<double, 3> weight{};  // of the triangle's corners
};

/// The axis along which a vector is longest; of equal ones the first.
inline int longest_axis(Vec3 a) {
  const Vec3 size{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

/// The first place of a segment, which is no point, in a triangle that it meets. The weights are right to 2^-50 of
/// themselves; so is what the time says along the longest axis of the segment.
CommonPlace exact_place(const Segment& segment, const Triangle& triangle);

}  // namespace tact::narrowphase

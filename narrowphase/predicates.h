// Exact signs of determinants of doubles: a floating-point filter, and integers where it cannot tell. There is no epsilon.
// Any finite coordinates up to 2^300 in size are decided exactly, subnormal ones included.
#pragma once

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
int orient3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d, PredicateCounts& counts);

// The sign of (a - c) × (b - c): +1 if a, b, c turn counter-clockwise, -1 clockwise, 0 on one line.
int orient2d(Point2 a, Point2 b, Point2 c, PredicateCounts& counts);

}  // namespace tact::narrowphase

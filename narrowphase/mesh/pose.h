// Where a rigid mesh stands: a rotation and a translation of its rest shape.
//
// A vertex p of the rest shape stands at R p + t. Each coordinate is ((R0 p.x + R1 p.y) + R2 p.z) + t, every operation
// rounded to double, in this order and without fused multiply-adds: everybody who computes it gets the same double.
// Rounding keeps order, so the corner of a box of the rest shape that lies farthest along a row of R, computed the same
// way, is never nearer than a vertex in that box. Boxes of a pose need no widening therefore.
#pragma once

#include <array>

#include "engine/base/box.h"
#include "engine/base/vec3.h"

namespace tact::narrowphase {

using base::Box;
using base::Vec3;

struct Pose {
  std::array<Vec3, 3> rows{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};  ///< of the rotation
  Vec3 translation;                                                                         ///< metres
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// R p + t, as described above.
inline Vec3 placed(const Pose& pose, Vec3 p) {
  Vec3 q;
  for (int axis = 0; axis < 3; ++axis) q[axis] = dot(pose.rows[axis], p) + pose.translation[axis];
  return q;
}

/// A box of all that stands in `box` at rest; empty if that is.
inline Box placed(const Pose& pose, const Box& box) {
  if (box.empty()) return box;
  Box result;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 row = pose.rows[axis];
    Vec3 low, high;
    for (int k = 0; k < 3; ++k) {
      low[k] = row[k] >= 0.0 ? box.lower[k] : box.upper[k];
      high[k] = row[k] >= 0.0 ? box.upper[k] : box.lower[k];
    }
    // Adding zero turns -0 into +0, as a refit does.
    result.lower[axis] = (dot(row, low) + pose.translation[axis]) + 0.0;
    result.upper[axis] = (dot(row, high) + pose.translation[axis]) + 0.0;
  }
  return result;
}

}  // namespace tact::narrowphase

// The size of boxes, and how they are grown by a reach, in numbers that round.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/base/box.h"

namespace tact::narrowphase {

inline double largest_coordinate(const base::Box& box) { return largest_coordinate(farthest_from({}, box)); }

inline double longest_side(const base::Box& box) {
  const base::Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

/// A reach that box tests, which round, can take: what is nearer than `reach` lies in boxes grown by this, as long as
/// no coordinate is larger than `largest`. Zero stays zero: boxes that are not grown do not round.
inline double box_reach(double reach, double largest) {
  return reach > 0.0 ? reach * (1.0 + 0x1p-40) + 0x1p-50 * largest : 0.0;
}

/// Rounded to nearest.
inline base::Box inflated(const base::Box& box, double by) {
  return {box.lower - base::Vec3{by, by, by}, box.upper + base::Vec3{by, by, by}};
}

/// A box as it is seen from what goes `frame`, not smaller for any rounding.
inline base::Box seen_from(const base::Vec3& frame, const base::Box& box) {
  if (frame == base::Vec3{} || box.empty()) return box;
  const double by = 0x1p-51 * (largest_coordinate(box) + largest_coordinate({frame, frame}));
  return inflated({box.lower - frame, box.upper - frame}, by);
}

}  // namespace tact::narrowphase

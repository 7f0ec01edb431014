// What the kernel open_cluster() is given to take the facets in a box, and no others.
#pragma once

#include <limits>

#include "narrowphase/mesh/box_arrays.h"

namespace tact::narrowphase {

/// A box that holds everything.
inline Box everywhere() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}

/// Planes that leave all facets whose boxes reach into `box`.
inline CullPlanes planes_of(const Box& box) {
  return {.axis = {}, .lowest = -std::numeric_limits<double>::infinity(), .box = bounds_of(box)};
}

}  // namespace tact::narrowphase

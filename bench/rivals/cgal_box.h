// What CGAL's box_intersection_d and box_self_intersection_d take.
#pragma once

#include <cstddef>

#include "engine/base/box.h"

namespace tact::bench {

// A model of CGAL's BoxIntersectionBox_d.
struct CgalBox {
  using NT = double;
  using ID = std::size_t;
  static int dimension() { return 3; }
  double min_coord(int axis) const { return box.lower[axis]; }
  double max_coord(int axis) const { return box.upper[axis]; }
  ID id() const { return number; }

  base::Box box;
  std::size_t number = 0;  // unique among all boxes of a call
};

}  // namespace tact::bench

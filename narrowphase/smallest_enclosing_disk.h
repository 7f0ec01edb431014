// The smallest disk that holds given points of a plane.
#pragma once

#include <span>

#include "narrowphase/predicates.h"

namespace tact::narrowphase {

struct Disk {
  Point2 center;
  double radius = -1.0;  // negative: no points
};

// The smallest disk that holds all `points`, in expected linear time (Welzl, "Smallest enclosing disks", 1991, iterative,
// in a fixed pseudo-random order, so the answer depends on the points alone). The radius is rounded up: as computed by
// sqrt((x - cx)² + (y - cy)²), no point is outside. `points` is reordered.
Disk smallest_enclosing_disk(std::span<Point2> points);

}  // namespace tact::narrowphase

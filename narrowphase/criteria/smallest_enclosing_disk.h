// The smallest disk that holds given points of a plane.
#pragma once

#include <span>

#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

struct Disk {
  Point2 center;
  double radius = -1.0;  // negative: no points
};

// The smallest disk that holds all `points`, which may be many, few, equal or on one line. No point lies outside,
// neither in real arithmetic nor as hypot(x - cx, y - cy) computes it, and the radius exceeds the smallest one by less
// than 1e-12 of itself plus the rounding of the center's own coordinates. The answer depends on the set of points
// alone, bit for bit: not on their order, nor on how often one is repeated.
//
// A disk around 2 or 3 points is grown by the farthest point outside until there is none (Gärtner, "Fast and robust
// smallest enclosing balls", ESA 1999, in the plane, where at most 4 points decide each step). Each step is one pass
// over the points; 4 to 10 passes are usual.
Disk smallest_enclosing_disk(std::span<const Point2> points);

}  // namespace tact::narrowphase

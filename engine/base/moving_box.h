// A box that goes straight from one place to another, and holds points that do: of these the least coordinate is
// concave in time, so it is nowhere below the chord between its ends.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/base/box.h"

namespace tact::base {

struct MovingBox {
  Box begin, end;
};

/// A part of the step; none if `from` is above `to`.
struct TimeSpan {
  double from = 0.0, to = 1.0;
};

/// When two boxes are within `reach` of each other along all axes, right to some roundings: six inequalities, each
/// linear in time.
inline TimeSpan near_span(const MovingBox& a, const MovingBox& b, double reach) {
  TimeSpan span;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool a_is_lower : {true, false}) {
      const MovingBox &low = a_is_lower ? a : b, &high = a_is_lower ? b : a;
      const double begin = high.begin.lower[axis] - low.begin.upper[axis] - reach,
                   end = high.end.lower[axis] - low.end.upper[axis] - reach;
      if (!(begin > 0.0 || end > 0.0)) continue;
      if (begin > 0.0 && end > 0.0) return {std::numeric_limits<double>::infinity(), 0.0};
      const double crossing = begin / (begin - end);
      if (begin > 0.0)
        span.from = std::max(span.from, crossing);
      else
        span.to = std::min(span.to, crossing);
    }
  }
  return span;
}

/// The way along an axis that two things have in common, each going its own: as long as the shorter one, or zero where
/// they go against each other.
inline double common_way(double a, double b) {
  if (a > 0.0 && b > 0.0) return std::min(a, b);
  return a < 0.0 && b < 0.0 ? std::max(a, b) : 0.0;
}

/// How far the middle of a box goes.
inline Vec3 way_of(const MovingBox& box) {
  return 0.5 * ((box.end.lower - box.begin.lower) + (box.end.upper - box.begin.upper));
}

}  // namespace tact::base

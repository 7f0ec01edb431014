// An axis-aligned box of doubles, closed: boxes that touch overlap.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/vec3.h"

namespace tact::base {

struct Box {
  // A box without points: it overlaps nothing and extending it by a point gives that point.
  Vec3 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
  Vec3 upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

  bool empty() const { return !(lower.x <= upper.x); }
  friend bool operator==(const Box&, const Box&) = default;
};

inline bool overlaps(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

inline Box merged(const Box& a, const Box& b) {
  return {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y), std::min(a.lower.z, b.lower.z)},
          {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y), std::max(a.upper.z, b.upper.z)}};
}

inline Box intersection(const Box& a, const Box& b) {
  return {{std::max(a.lower.x, b.lower.x), std::max(a.lower.y, b.lower.y), std::max(a.lower.z, b.lower.z)},
          {std::min(a.upper.x, b.upper.x), std::min(a.upper.y, b.upper.y), std::min(a.upper.z, b.upper.z)}};
}

// The box with all that is at most `by` away from it, rounded outwards.
inline Box grown(const Box& box, double by) {
  if (by == 0.0 || box.empty()) return box;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box result;
  for (int axis = 0; axis < 3; ++axis) {
    result.lower[axis] = std::nextafter(box.lower[axis] - by, -kInfinity);
    result.upper[axis] = std::nextafter(box.upper[axis] + by, kInfinity);
  }
  return result;
}

inline Box extended(const Box& box, Vec3 p) { return merged(box, {p, p}); }

inline bool contains(const Box& box, Vec3 p) { return overlaps(box, {p, p}); }
/// Whether a box that is not empty lies in another one.
inline bool lies_in(const Box& inner, const Box& box) {
  return !inner.empty() && contains(box, inner.lower) && contains(box, inner.upper);
}

/// How far what is in the box is from a point at most, along each axis.
inline Vec3 farthest_from(Vec3 p, const Box& box) {
  const Vec3 lower = box.lower - p, upper = box.upper - p;
  return {std::max(std::abs(lower.x), std::abs(upper.x)), std::max(std::abs(lower.y), std::abs(upper.y)),
          std::max(std::abs(lower.z), std::abs(upper.z))};
}

}  // namespace tact::base

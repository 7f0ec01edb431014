// Sixteen boxes side by side: what the hierarchy is made of, on every level, and what one SIMD loop compares.
//
// Bounds are floats, but nothing is rounded outward. The map f from doubles to floats is monotone: a <= b makes f(a) <=
// f(b), and f(a) < f(b) makes a < b. So boxes that are separated as floats are separated, and boxes that overlap by
// more than touching as floats overlap. Only if two floats are equal are the doubles compared, and not even then if
// both floats are exact.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/base/box.h"

namespace tact::broadphase {

using base::Box;

inline constexpr std::uint32_t kLanes = 16;
inline constexpr std::uint32_t kAllLanes = 0xffffu;  // one bit a lane

inline constexpr double kLargestFloat = std::numeric_limits<float>::max();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Whether the box has points. One that is empty along any axis overlaps nothing.
inline bool occupied(const Box& box) {
  return box.lower.x <= box.upper.x && box.lower.y <= box.upper.y && box.lower.z <= box.upper.z;
}

struct FloatBox {
  float lower[3];
  float upper[3];
};

// A lane without a box has lower = +infinity and upper = -infinity on every axis, and so overlaps nothing.
struct alignas(64) Block {
  float lower[3][kLanes];
  float upper[3][kLanes];
  FloatBox bounds;            // the box of all lanes
  std::uint32_t exact_lanes;  // lanes whose floats give back the doubles, those without a box included
};

// Where the floats have their origin: they are sharpest there.
struct Frame {
  double origin[3] = {0.0, 0.0, 0.0};
};

// Monotone in x, and finite.
inline float to_float(double x, double origin) {
  const double offset = x - origin;
  return static_cast<float>(offset < -kLargestFloat ? -kLargestFloat : kLargestFloat < offset ? kLargestFloat : offset);
}

// Whether the float gives back the double. Equal floats that both do mean equal doubles.
inline bool is_exact(float value, double x, double origin) { return static_cast<double>(value) + origin == x; }

}  // namespace tact::broadphase

// Angles from sums, products, quotients and roots alone: the same bits on every machine.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/base/vec3.h"

namespace tact::narrowphase {

/// The angle between two vectors, 0 to pi; off by less than 2^-48. Zero if one of them is zero.
inline double angle_between(base::Vec3 p, base::Vec3 q) {
  const double turn = norm(cross(p, q)), along = dot(p, q), length = std::sqrt(turn * turn + along * along);
  if (!(length > 0.0)) return 0.0;
  // The tangent of half the angle, or of half of what it lacks to pi, and of a quarter and an eighth of it.
  double tangent = turn / (length + std::abs(along));
  for (int halved = 0; halved < 2; ++halved) tangent = tangent / (1.0 + std::sqrt(1.0 + tangent * tangent));
  // The tangent is at most 0.2: after 12 terms Gregory's series is off by 2^-56 of itself.
  double sum = 0.0;
  for (int term = 11; term >= 0; --term) sum = 1.0 / (2 * term + 1) - tangent * tangent * sum;
  const double angle = 8.0 * tangent * sum;
  return along < 0.0 ? std::numbers::pi - angle : angle;
}

}  // namespace tact::narrowphase

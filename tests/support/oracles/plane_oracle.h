// Heights over a plane in rational numbers. They share no code with the engine.
#pragma once

#include <optional>

#include "tests/support/mesh.h"

namespace tact::tests {

/// All x with normal · x <= offset.
struct ExactPlane {
  Vec3 normal;
  double offset = 0.0;
};

/// normal · p - offset as the nearest double, of two equally near ones the even one.
double exact_height(const ExactPlane& plane, Vec3 p);
/// The part of the way at which a point that moves straight first comes as near to the plane as `reach`, as the largest
/// double that is not above it; none if it does not.
std::optional<double> exact_time(const ExactPlane& plane, Vec3 from, Vec3 to, double reach);
/// The same for a reach of zero, as the nearest double.
std::optional<double> exact_fraction(const ExactPlane& plane, Vec3 from, Vec3 to);

}  // namespace tact::tests

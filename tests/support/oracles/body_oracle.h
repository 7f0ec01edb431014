// What two meshes are to each other, by brute force: distances in rational numbers, turns in 50 digits.
#pragma once

#include <optional>

#include "tests/support/mesh.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::tests {

/// The distance of two triangles, exact before it is rounded.
double exact_distance(const Triangle& t, const Triangle& u);

/// The least distance of two meshes. Pairs of facets whose boxes are farther apart than `guess`, which must not be
/// below it, are left out.
double exact_distance(const Mesh& a, const Mesh& b, double guess);

/// The first part of a turn, by `angle` about an axis through the origin, at which a triangle meets another one; none
/// if it does not. Where they meet from the beginning it is zero.
std::optional<double> first_on_turn(const Triangle& t, Vec3 axis, double angle, const Triangle& u);

}  // namespace tact::tests

// What a contact says of itself, checked by brute force.
#pragma once

#include <gtest/gtest.h>
#include <tact/report.h>

#include <optional>

#include "engine/eigen_vectors.h"
#include "tests/support/mesh.h"

namespace tact::tests {

// Does all that `contact` says of direction, depth and planes hold for the bodies `a` and `b`? The direction is of unit
// length and a local minimum of the overlap, the depth is the overlap, the planes are where the hulls end, and no limit
// was reached. Rounding is allowed for by 1e-13 of the bodies' size.
::testing::AssertionResult is_sound(const Contact& contact, const Mesh& a, const Mesh& b);

// The contact of two bodies in a world of their own, if their hulls overlap. Its lists of facet pairs and patches are
// gone.
std::optional<Contact> contact_of(const Mesh& a, const Mesh& b);

}  // namespace tact::tests

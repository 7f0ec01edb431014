// Where a facet is nearest to a vertex, or to any point.
#pragma once

#include <array>
#include <optional>

#include "narrowphase/distance/nearest.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The minimum of the distance from `v` inside the facet with these corners, if there is one nearer than `limit`.
std::optional<Nearest> nearest_inside_facet(Vec3 v, const Vec3 (&corner)[3], double limit);

inline Vec3 place_of(const Triangle& t, const std::array<double, 3>& w) {
  return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

/// The weights of the corners for the place of a triangle that is nearest to `p`; lengths are near 1.
std::array<double, 3> nearest_weights(Vec3 p, const Triangle& t);
/// The same for the place of its sides that is nearest.
std::array<double, 3> nearest_weights_on_sides(Vec3 p, const Triangle& t);
/// nearest_weights() for lengths of any size.
std::array<double, 3> weights_about(Vec3 p, const Triangle& t);

}  // namespace tact::narrowphase

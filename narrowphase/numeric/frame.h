// Two axes across a direction.
#pragma once

#include <cmath>

#include "engine/base/vec3.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

// (u, v, n) is a right-handed orthonormal frame.
struct Frame {
  base::Vec3 u;
  base::Vec3 v;
};

// A frame across the unit vector n, by a rule without branches or small denominators (Duff et al., "Building an
// Orthonormal Basis, Revisited", JCGT 2017).
inline Frame frame_across(base::Vec3 n) {
  const double sign = std::copysign(1.0, n.z), p = -1.0 / (sign + n.z), q = n.x * n.y * p;
  return {{1.0 + sign * n.x * n.x * p, sign * q, -sign * n.x}, {q, sign + n.y * n.y * p, -n.y}};
}

// Three unit vectors across a direction, a third of a turn apart, in coordinates u and v.
inline constexpr Point2 kThirds[3] = {{1.0, 0.0}, {-0.5, 0.8660254037844386}, {-0.5, -0.8660254037844386}};

}  // namespace tact::narrowphase

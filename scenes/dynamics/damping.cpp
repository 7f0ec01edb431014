#include "scenes/dynamics/damping.h"

#include <cmath>

namespace tact::scenes {

void damp_inner_motion(Body& body, double seconds) {
  double mass = 0.0;
  Vec3 center, momentum;
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    if (!(body.inverse_masses[v] > 0.0)) continue;
    const double m = 1.0 / body.inverse_masses[v];
    mass += m;
    center = center + m * body.positions[v];
    momentum = momentum + m * body.velocities[v];
  }
  if (!(mass > 0.0)) return;
  center = (1.0 / mass) * center;
  const Vec3 drift = (1.0 / mass) * momentum;

  Vec3 spin;                             // angular momentum
  Vec3 inertia_x, inertia_y, inertia_z;  // rows
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    if (!(body.inverse_masses[v] > 0.0)) continue;
    const double m = 1.0 / body.inverse_masses[v];
    const Vec3 r = body.positions[v] - center;
    spin = spin + m * cross(r, body.velocities[v]);
    const double square = norm_squared(r);
    inertia_x = inertia_x + m * (Vec3{square, 0.0, 0.0} - r.x * r);
    inertia_y = inertia_y + m * (Vec3{0.0, square, 0.0} - r.y * r);
    inertia_z = inertia_z + m * (Vec3{0.0, 0.0, square} - r.z * r);
  }
  const double determinant = dot(inertia_x, cross(inertia_y, inertia_z));
  Vec3 turning;  // radians a second; none for a body without extent across some axis
  if (determinant > 0.0) {
    turning = (1.0 / determinant) * (spin.x * cross(inertia_y, inertia_z) + spin.y * cross(inertia_z, inertia_x) +
                                     spin.z * cross(inertia_x, inertia_y));
  }
  const double share = 1.0 - std::exp(-body.inner_damping * seconds);
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    if (!(body.inverse_masses[v] > 0.0)) continue;
    const Vec3 rigid = drift + cross(turning, body.positions[v] - center);
    body.velocities[v] = body.velocities[v] + share * (rigid - body.velocities[v]);
  }
}

}  // namespace tact::scenes

#include "scenes/dynamics/hull_push.h"

namespace tact::scenes {
namespace {

struct Slab {
  Vec3 direction;
  double lower, upper;

  bool holds(Vec3 p) const {
    const double height = dot(direction, p);
    return height >= lower && height <= upper;
  }
};

void push(Body& body, const Slab& slab, Vec3 impulse) {
  double mass = 0.0;
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    if (body.inverse_masses[v] > 0.0 && slab.holds(body.positions[v])) mass += 1.0 / body.inverse_masses[v];
  }
  if (!(mass > 0.0)) return;
  const Vec3 change = (1.0 / mass) * impulse;
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    if (body.inverse_masses[v] > 0.0 && slab.holds(body.positions[v])) body.velocities[v] = body.velocities[v] + change;
  }
}

}  // namespace

void push_hulls_apart(std::span<const Contact> contacts, std::vector<Body>& bodies, double seconds) {
  for (const Contact& contact : contacts) {
    Body& a = bodies[contact.a.index];
    Body& b = bodies[contact.b.index];
    const double force = (a.hull_stiffness + b.hull_stiffness) * contact.depth;
    if (!(force > 0.0)) continue;
    const Vec3 direction{contact.direction.x(), contact.direction.y(), contact.direction.z()};
    const Slab slab{direction, contact.plane_b, contact.plane_a};
    push(a, slab, (-seconds * force) * direction);
    push(b, slab, (seconds * force) * direction);
  }
}

}  // namespace tact::scenes

#include "scenes/dynamics/rigid_motion.h"

#include <algorithm>

namespace tact::scenes {

RigidMotion::RigidMotion(const std::vector<Vec3>& positions, double mass)
    : local_(positions), inverse_mass_(1.0 / mass) {
  const double share = 1.0 / static_cast<double>(positions.size());
  for (const Vec3& p : positions) center_ = center_ + share * p;
  Matrix& inertia = inertia_at_rest_;
  for (Vec3& r : local_) {
    r = r - center_;
    const double square = norm_squared(r), m = mass * share;
    inertia[0] = inertia[0] + m * (Vec3{square, 0.0, 0.0} - r.x * r);
    inertia[1] = inertia[1] + m * (Vec3{0.0, square, 0.0} - r.y * r);
    inertia[2] = inertia[2] + m * (Vec3{0.0, 0.0, square} - r.z * r);
    radius_ = std::max(radius_, std::sqrt(square));
  }
  inverse_inertia_at_rest_ = inverse(inertia);
  turn_matrices();
}

void RigidMotion::turn_matrices() {
  turn_of_body_ = matrix(rotation_);
  inverse_inertia_ = product(turn_of_body_, product(inverse_inertia_at_rest_, transposed(turn_of_body_)));
}

// The moment of inertia is taken as constant over a substep: a body that spins fast about no axis of its own loses its
// precession, which no pile shows.
void RigidMotion::begin_substep(double h, Vec3 fall, double keep) {
  shift_ = (h * keep) * (velocity_ + fall);
  turn_ = (h * keep) * spin_;
}

void RigidMotion::end_substep(double h) {
  velocity_ = (1.0 / h) * shift_;
  spin_ = (1.0 / h) * turn_;
  center_ = center_ + shift_;
  rotation_ = rotated(rotation_, turn_);
  turn_matrices();
}

void RigidMotion::place(std::vector<Vec3>& positions) const {
  for (std::size_t v = 0; v < local_.size(); ++v) positions[v] = center_ + turn_of_body_ * local_[v];
}

double RigidMotion::kinetic_energy() const {
  const Vec3 spin = transposed(turn_of_body_) * spin_;
  return 0.5 * norm_squared(velocity_) / inverse_mass_ + 0.5 * dot(spin, inertia_at_rest_ * spin);
}

}  // namespace tact::scenes

// A rigid body that forces move: where it is, how it is turned, and how it goes on.
#pragma once

#include <vector>

#include "scenes/dynamics/mesh.h"
#include "scenes/dynamics/rotation.h"

namespace tact::scenes {

class RigidMotion {
 public:
  // Vertices of equal mass, which add up to `mass` kilograms.
  RigidMotion(const std::vector<Vec3>& positions, double mass);

  // Begins a substep of `h` seconds: the body goes on as it did, `fall` metres a second faster, and slowed down by the
  // factor `keep`.
  void begin_substep(double h, Vec3 fall, double keep);
  // Takes the way of the substep, and what contacts made of it, for the motion.
  void end_substep(double h);
  void stop() { velocity_ = spin_ = {}; }

  // A point of the body, from its centre as it was turned when the substep began.
  Vec3 arm(Vec3 local) const { return turn_of_body_ * local; }
  Vec3 before(Vec3 arm) const { return center_ + arm; }
  // Where it is now, to first order in the turn of one substep.
  Vec3 now(Vec3 arm) const { return center_ + arm + shift_ + cross(turn_, arm); }
  // How far a unit impulse along `direction` moves the point along it: 1/m + (r x n) I⁻¹ (r x n). Source: M. Müller et
  // al., Detailed Rigid Body Simulation with Extended Position Based Dynamics, SCA 2020.
  double give(Vec3 arm, Vec3 direction) const {
    const Vec3 lever = cross(arm, direction);
    return inverse_mass_ + dot(lever, inverse_inertia_ * lever);
  }
  void push(Vec3 arm, Vec3 impulse) {
    shift_ = shift_ + inverse_mass_ * impulse;
    turn_ = turn_ + inverse_inertia_ * cross(arm, impulse);
  }
  // Half of the way of the substep is taken back.
  void retreat() {
    shift_ = 0.5 * shift_;
    turn_ = 0.5 * turn_;
  }
  // No vertex goes farther than `most` metres in the substep.
  void shorten(double most) {
    if (!(way() > most)) return;
    const double part = most / way();
    shift_ = part * shift_;
    turn_ = part * turn_;
  }
  // No vertex went farther in the substep, metres.
  double way() const { return norm(shift_) + norm(turn_) * radius_; }

  // The vertices from the centre of mass, unturned, metres.
  const std::vector<Vec3>& local() const { return local_; }
  void place(std::vector<Vec3>& positions) const;
  double kinetic_energy() const;  // joules
  double mass() const { return 1.0 / inverse_mass_; }

 private:
  void turn_matrices();

  std::vector<Vec3> local_;
  double inverse_mass_ = 0.0;  // 1 / kilograms
  double radius_ = 0.0;        // of the farthest vertex, metres
  Matrix inertia_at_rest_ = {}, inverse_inertia_at_rest_ = {};
  Vec3 center_, velocity_, spin_;  // metres, metres a second, radians a second
  Quaternion rotation_;
  Vec3 shift_, turn_;  // since the substep began, metres and radians
  // As the body is turned at the beginning of the substep.
  Matrix turn_of_body_ = {}, inverse_inertia_ = {};
};

}  // namespace tact::scenes

// A cloth falls on a ball, folds on itself, and rests: XPBD on the stencils of tact/solver.h, in small steps (M.
// Macklin et al., Small Steps in Physics Simulation, 2019). Ask tact where the substep begins, move, pull springs back,
// keep apart what it named. Status 0: nothing ever crossed, and the cloth rests as that of newton.cpp.
#include <algorithm>

#include "examples/cloth_scene.h"

using namespace cloth_scene;
using namespace tact::solver;

constexpr double kSubstep = 1.0 / 960.0;  // seconds
constexpr int kSubsteps = 3840;
constexpr double kAhead = 0.002;  // metres a body: nothing comes nearer by twice that in a substep, 3.8 m/s

// Toward the length at rest, by the stiffness of the spring (M. Macklin et al., XPBD, 2016).
void pull(const Spring& spring, double inverse_mass, Matrix3Xd& x) {
  const Vector3d way = x.col(spring.b) - x.col(spring.a);
  const double share = inverse_mass / (2.0 * inverse_mass + 1.0 / (kSpring * kSubstep * kSubstep));
  const Vector3d moved = share * (1.0 - spring.length / way.norm()) * way;
  x.col(spring.a) += moved;
  x.col(spring.b) -= moved;
}

// [part contacts]
// Moves the two places of a stencil apart, then takes back what they slid since `begin`, by Coulomb's law.
void keep_apart(const Stencil& stencil, const std::vector<double>& inverse_masses, const Matrix3Xd& begin,
                Matrix3Xd& x) {
  const Corners now = gather(stencil, x);
  const double missing = kThickness - stencil.normal.dot(difference(stencil, now));
  const double mass = effective_mass(stencil, inverse_masses);
  if (missing <= 0.0 || !std::isfinite(mass)) return;
  const Tangents across = tangents(stencil.normal);
  const Eigen::Vector2d slid = sliding(stencil, across, now - gather(stencil, begin));
  const double held = std::min(1.0, kFriction * missing / std::max(slid.norm(), 1e-12));
  push(stencil, mass * (missing * stencil.normal - held * (across * slid)), inverse_masses, x);
}
// [part contacts]

int main() {
  Scene scene(kThickness / 2 + kAhead, {.points = true});
  const std::vector<double> inverse_masses(static_cast<std::size_t>(scene.moving), 1.0 / scene.mass());
  Matrix3Xd velocity = Matrix3Xd::Zero(3, scene.x.cols());
  for (int substep = 0; substep < kSubsteps; ++substep) {
    const std::vector<Stencil> found = stencils(scene.detect(), scene.first_rows);
    const Matrix3Xd begin = scene.x;
    velocity.row(2).head(scene.moving).array() -= kGravity * kSubstep;
    scene.x += kSubstep / (1.0 + kDrag * kSubstep) * velocity;
    for (const Spring& spring : scene.springs) pull(spring, inverse_masses[0], scene.x);
    for (const Stencil& stencil : found) keep_apart(stencil, inverse_masses, begin, scene.x);
    velocity = (scene.x - begin) / kSubstep;
  }
  return scene.report(velocity) ? 0 : 1;
}

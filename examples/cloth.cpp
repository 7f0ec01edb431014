// A cloth falls on a ball, folds on itself, and rests: position-based dynamics of one page that lives on contact points
// alone. Small steps (M. Macklin et al., Small Steps in Physics Simulation, SCA 2019): find contacts where the substep
// begins and nothing has crossed, move, pull springs back, keep apart what tact named. Status 0: nothing ever crossed,
// and the cloth hangs over the ball.   usage: example_cloth [VERTICES a side]
#include <algorithm>
#include <cstdlib>

#include "examples/cloth_scene.h"

using namespace cloth_scene;
using namespace tact::solver;

constexpr double kSubstep = 1.0 / 720.0;                     // seconds
constexpr double kMargin = kThickness / 2 + 4.0 * kSubstep;  // of each body: what both come nearer at 8 m/s, too

// [part solve]
// Moves the two places of a stencil apart, then takes back what they slid, by Coulomb's law.
void keep_apart(const Stencil& stencil, std::span<const double> inverse_masses, const Matrix3Xd& before, Matrix3Xd& x) {
  const Vector3d between = difference(stencil, gather(stencil, x)), n = stencil.normal;
  const double missing = kThickness - n.dot(between), mass = effective_mass(stencil, inverse_masses);
  if (missing <= 0.0) return;
  Vector3d slid = between - difference(stencil, gather(stencil, before));
  slid -= slid.dot(n) * n;
  const double held = std::min(1.0, kFriction * missing / std::max(slid.norm(), 1e-12));
  push(stencil, mass * (missing * n - held * slid), inverse_masses, x);
}
// [part solve]

int main(int count, char** arguments) {
  Scene scene(count > 1 ? std::atoi(arguments[1]) : 24, kMargin);
  const std::vector<double> inverse_masses(static_cast<std::size_t>(scene.moving), 1.0);
  Matrix3Xd& x = scene.x;
  Matrix3Xd velocity = Matrix3Xd::Zero(3, scene.moving);
  for (int substep = 0; substep < 1800; ++substep) {
    const Matrix3Xd before = x;
    const std::vector<Stencil> stencils = scene.detect();
    velocity.row(2).array() -= kGravity * kSubstep;
    x.leftCols(scene.moving) += kSubstep / (1.0 + kDrag * kSubstep) * velocity;
    for (const Spring& spring : scene.springs) {
      const Vector3d way = x.col(spring.b) - x.col(spring.a);
      const Vector3d half = 0.25 * (1.0 - spring.length / way.norm()) * way;
      x.col(spring.a) += half;
      x.col(spring.b) -= half;
    }
    for (const Stencil& stencil : stencils) keep_apart(stencil, inverse_masses, before, x);
    velocity = (x - before).leftCols(scene.moving) / kSubstep;
  }
  return scene.report(velocity) ? 0 : 1;
}

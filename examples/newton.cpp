// A cloth that falls on a ball, in implicit steps of 1/60 s: Newton's method on inertia, springs, a barrier and
// friction (Li et al., Incremental Potential Contact, 2020). No iteration moves farther than detect_motion() lets it,
// so nothing ever crosses. Status 0: the cloth rests as that of cloth.cpp.
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "examples/cloth_scene.h"

using namespace cloth_scene;
using namespace tact::solver;
using Eigen::VectorXd;

constexpr double kStep = 1.0 / 60.0;         // seconds
constexpr double kBarrier = 400.0;           // N/m
constexpr double kSmoothing = 1e-3 * kStep;  // metres: what slips slower than 1 mm/s is held softly
constexpr double kEnough = 5e-3 * kStep;     // metres: the least Newton step, 5 mm/s
constexpr int kIterations = 40, kSteps = 110;

struct Friction {
  Stencil stencil;
  Tangents tangents;
  double limit;  // newtons, from the barrier where the step began
};

// What a step minimizes: its energy, and with `triplets` gradient and Hessian, too.
struct Objective {
  const Scene& scene;
  Matrix3Xd begin, goal;  // where the step began, and where inertia leads; of the cloth
  std::vector<Friction> friction;

  double operator()(const Matrix3Xd& x, const std::vector<ReachStencil>& pairs, VectorXd* gradient,
                    std::vector<Eigen::Triplet<double>>* triplets) const {
    const int moving = scene.moving;
    const double inertia = scene.mass() / (kStep * kStep);
    const Matrix3Xd off = x.leftCols(moving) - goal;
    double energy = 0.5 * inertia * off.squaredNorm();
    if (gradient != nullptr) {
      *gradient = inertia * off.reshaped();
      for (int row = 0; row < 3 * moving; ++row) triplets->emplace_back(row, row, inertia);
    }
    const auto add = [&](const Stencil& stencil, double scale, const Term& term) {
      energy += scale * term.value;
      if (gradient == nullptr) return;
      add_gradient(stencil, scale * term.gradient, *gradient);
      append_triplets(stencil, scale * term.hessian, moving, *triplets);
    };
    for (const Spring& spring : scene.springs) {  // a spring is a penalty of the distance of its ends
      const Stencil stencil{.vertices = {spring.a, spring.b, -1, -1}, .weights = {-1.0, 1.0, 0.0, 0.0}};
      const Term distance = gap_of(stencil, gather(stencil, x)).distance;
      const double stretch = distance.value - spring.length;
      Term term = chain({0.5 * stretch * stretch, stretch, 1.0}, distance);
      if (stretch < 0.0) term.hessian = distance.gradient * distance.gradient.transpose();
      add(stencil, kSpring, term);
    }
    for (const ReachStencil& pair : pairs) {
      const Term term = barrier_term(pair, x, kThickness);
      add(pair.whole, kBarrier, gradient != nullptr ? projected(term) : term);
    }
    Matrix3Xd moved = Matrix3Xd::Zero(3, x.cols());
    moved.leftCols(moving) = x.leftCols(moving) - begin;
    for (const Friction& one : friction)
      add(one.stencil, 1.0,
          friction_term(one.stencil, one.tangents, gather(one.stencil, moved), one.limit, kSmoothing));
    return energy;
  }
};

// [part newton]
// One Newton step from scene.x; returns how far it wanted to move a vertex.
double iterate(Scene& scene, const Objective& objective, const std::vector<ReachStencil>& pairs) {
  VectorXd gradient;
  std::vector<Eigen::Triplet<double>> triplets;
  const double energy = objective(scene.x, pairs, &gradient, &triplets);
  Eigen::SparseMatrix<double> hessian(gradient.size(), gradient.size());
  hessian.setFromTriplets(triplets.begin(), triplets.end());
  const VectorXd way = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(hessian).solve(-gradient);
  Matrix3Xd full = scene.x;
  full.leftCols(scene.moving) += way.reshaped(3, scene.moving);
  scene.world.set_positions(scene.cloth, full.leftCols(scene.moving));
  const tact::MotionOptions crossing{.wanted = tact::Impacts::first, .distance = 0.0};  // not the reach of the barrier
  double part = std::min(1.0, 0.9 * scene.world.detect_motion(crossing).first_time());
  const Matrix3Xd from = scene.x;
  for (int halving = 0; halving < 30; ++halving, part *= 0.5) {
    scene.x = from + part * (full - from);
    if (objective(scene.x, pairs, nullptr, nullptr) <= energy) break;
  }
  return way.cwiseAbs().maxCoeff();
}
// [part newton]

int main() {
  Scene scene(kThickness / 2, {.within_reach = true});
  Matrix3Xd velocity = Matrix3Xd::Zero(3, scene.moving);
  for (int step = 0; step < kSteps; ++step) {
    Objective objective{scene, scene.x.leftCols(scene.moving), {}, {}};
    velocity.row(2).array() -= kGravity * kStep;
    objective.goal = objective.begin + kStep / (1.0 + kDrag * kStep) * velocity;
    std::vector<ReachStencil> pairs = stencils_within_reach(scene.detect(), scene.first_rows);
    for (const ReachStencil& pair : pairs)
      objective.friction.push_back({pair.closest, tangents(pair.closest.normal),
                                    -kFriction * kBarrier * barrier(pair.closest.gap, kThickness).first});
    for (int i = 0; i < kIterations && iterate(scene, objective, pairs) > kEnough; ++i)
      pairs = stencils_within_reach(scene.detect(), scene.first_rows);
    velocity = (scene.x.leftCols(scene.moving) - objective.begin) / kStep;
  }
  return scene.report(velocity) ? 0 : 1;
}

// A solver that includes tact/solver.h and nothing else of tact: a triangle falls onto another one and rests above it,
// by an implicit step with a barrier. It ends with status 0.
#include <tact/solver.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  Eigen::Matrix3Xd x(3, 6);  // the falling triangle first
  x << 0, 1, 0, -3, 3, 0, 0, 0, 1, -3, -3, 4, 0.1, 0.11, 0.12, 0, 0, 0;
  Eigen::Matrix3Xi facets(3, 1);
  facets << 0, 1, 2;
  tact::World world({.outputs = {.points = true}});
  const tact::Surface sheet = tact::Surface::sheet;
  const tact::BodyId drop =
      world.add_body({.positions = x.leftCols(3), .facets = facets, .surface = sheet, .margin = 0.01});
  world.add_body(
      {.positions = x.rightCols(3), .facets = facets, .surface = sheet, .motion = tact::Motion::fixed, .margin = 0.01});
  const std::vector<int> first_rows{0, 3};
  const double h = 0.01, reach = 0.02, stiffness = 1e4;
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(9);
  for (int step = 0; step < 400; ++step) {
    const Eigen::Matrix3Xd before = x;
    velocity.array() *= 0.98;
    for (int k = 2; k < 9; k += 3) velocity[k] -= 9.81 * h;
    const Eigen::VectorXd goal = Eigen::Map<const Eigen::VectorXd>(before.data(), 9) + h * velocity;
    for (int iteration = 0; iteration < 20; ++iteration) {
      world.set_positions(drop, x.leftCols(3));
      Eigen::MatrixXd hessian = Eigen::MatrixXd::Identity(9, 9) / (h * h);
      Eigen::VectorXd gradient = (Eigen::Map<const Eigen::VectorXd>(x.data(), 9) - goal) / (h * h);
      for (const tact::solver::Stencil& stencil : tact::solver::stencils(world.detect(), first_rows)) {
        const tact::solver::Term term =
            tact::solver::projected(tact::solver::barrier_term(stencil, tact::solver::gather(stencil, x), reach));
        tact::solver::add_gradient(stencil, stiffness * term.gradient, gradient);
        tact::solver::for_each_entry(stencil, term.hessian, 3, [&](int row, int column, double value) {
          hessian(row, column) += stiffness * value;
        });
      }
      const Eigen::VectorXd way = -hessian.ldlt().solve(gradient);
      x.leftCols(3) += Eigen::Map<const Eigen::Matrix3Xd>(way.data(), 3, 3);
      world.set_positions(drop, x.leftCols(3));
      const double first = world.detect_motion(tact::Impacts::first).first_time();
      if (first <= 1.0) x.leftCols(3) -= (1.0 - 0.8 * first) * Eigen::Map<const Eigen::Matrix3Xd>(way.data(), 3, 3);
      if (way.lpNorm<Eigen::Infinity>() < 1e-9) break;
    }
    velocity =
        (Eigen::Map<const Eigen::VectorXd>(x.data(), 9) - Eigen::Map<const Eigen::VectorXd>(before.data(), 9)) / h;
  }
  std::printf("at rest at %.4f m, speed %.5f m/s\n", x(2, 0), velocity.norm());
  return x.row(2).head(3).minCoeff() > 0.0 && x(2, 0) < reach && velocity.norm() < 0.05 ? 0 : 1;
}

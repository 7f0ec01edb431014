// The barrier of Incremental Potential Contact over all that is within reach: a cloth slides over the edge of a box,
// and neither the energy nor its gradient jumps as vertices pass from facet to facet. Status 0: both are smooth.
#include <tact/solver.h>

#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

using Eigen::Matrix3Xd, Eigen::Matrix3Xi, Eigen::Vector3d;
using namespace tact::solver;

constexpr double kReach = 0.05;  // metres: the sum of the margins

// [part barrier]
struct Barrier {
  double energy = 0.0;
  Eigen::VectorXd gradient;  // three numbers for each vertex that moves
};

// Of all vertices `x` of which the first `moving` move, at the positions of the last set_positions().
Barrier barrier_of(tact::World& world, std::span<const int> first_rows, const Matrix3Xd& x, const Matrix3Xd& rest,
                   int moving) {
  Barrier sum{.gradient = Eigen::VectorXd::Zero(3 * moving)};
  for (const ReachStencil& pair : stencils_within_reach(world.detect(), first_rows)) {
    const double threshold = mollifier_threshold(gather(pair.whole, rest));
    const Term term = barrier_term(pair, x, kReach, threshold);
    sum.energy += term.value;
    add_gradient(pair.whole, term.gradient, sum.gradient);
  }
  return sum;
}
// [part barrier]

int main() {
  constexpr int kSide = 5, kMoving = kSide * kSide;
  Matrix3Xd rest(3, kMoving + 8);  // the cloth's vertices, then the box's
  Matrix3Xi cloth(3, 2 * (kSide - 1) * (kSide - 1)), box(3, 12);
  for (int v = 0; v < kMoving; ++v) rest.col(v) << 0.11 * (v % kSide), 0.13 * (v / kSide) - 0.2, 0.03;
  for (int v = 0; v < 8; ++v) rest.col(kMoving + v) << (v & 1) * 0.6 - 0.7, (v >> 1 & 1) - 0.5, (v >> 2) - 1.0;
  for (int f = 0; f < cloth.cols(); f += 2) {
    const int a = f / 2 + f / 2 / (kSide - 1);
    cloth.col(f) << a, a + 1, a + kSide + 1;
    cloth.col(f + 1) << a, a + kSide + 1, a + kSide;
  }
  box << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,     //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  tact::World world({.threads = 1, .outputs = {.within_reach = true}});
  const auto add = [&](const auto& x, const Matrix3Xi& facets, tact::Surface surface) {
    return world.add_body({.positions = Matrix3Xd(x), .facets = facets, .surface = surface, .margin = kReach / 2});
  };
  const tact::BodyId id = add(rest.leftCols(kMoving), cloth, tact::Surface::sheet);
  add(rest.rightCols(8), box, tact::Surface::closed);
  const std::vector<int> first_rows{0, kMoving};

  // A way across and along the edge of the box, in steps so small that the slope between two is that of the gradient.
  const Vector3d way(-0.25, 0.13, -0.004);
  constexpr int kSteps = 2000;
  double worst = 0.0, steepest = 0.0;
  Barrier last;
  for (int step = 0; step <= kSteps; ++step) {
    Matrix3Xd x = rest;
    x.leftCols(kMoving).colwise() += way * step / kSteps;
    world.set_positions(id, x.leftCols(kMoving));
    const Barrier now = barrier_of(world, first_rows, x, rest, kMoving);
    const auto slope = [&](const Barrier& one) { return one.gradient.reshaped(3, kMoving).rowwise().sum().dot(way); };
    if (step > 0) {
      const double middle = 0.5 * (slope(last) + slope(now));
      worst = std::max(worst, std::abs((now.energy - last.energy) * kSteps - middle));
      steepest = std::max(steepest, std::abs(middle));
    }
    last = now;
  }
  std::printf("the energy's slope is its gradient to %.1e of the steepest\n", worst / steepest);
  return worst < 1e-2 * steepest ? 0 : 1;
}

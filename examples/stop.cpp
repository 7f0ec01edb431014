// Tiles fall into a stack beside one that slides over the floor. A stop of everything before the first impact also
// stops what rests: the sliding tile touches the floor at all times. Impacts as constraints take from each way what
// leads through, and leave the rest. Status 0: nothing ever crossed, and the tile slid as if nothing were there.
#include <tact/report_arrays.h>
#include <tact/solver.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

using Eigen::Matrix3Xd, Eigen::Vector3d;
using namespace tact::solver;

constexpr int kTiles = 4, kMoving = 4 * kTiles, kSteps = 60;
constexpr double kStep = 1.0 / 60.0, kMargin = 1e-3;  // seconds, metres

struct Scene {
  tact::World world;
  Matrix3Xd x{3, kMoving + 4};  // the corners of the tiles, then those of the floor
  std::vector<tact::BodyId> tiles;
  std::vector<int> first_rows;

  Scene() {
    for (int k = 0; k < kTiles; ++k)
      add(0.5 - 0.1 * k, 0.2 * k, {k == 0 ? -2.0 : 2.0, 0.0, k == 0 ? 0.0015 : 0.3 * k}, false);
    add(4.0, 0.0, Vector3d::Zero(), true);
    world.detect();
  }
  void add(double half, double angle, const Vector3d& middle, bool fixed) {
    const int row = 4 * static_cast<int>(first_rows.size());
    const Vector3d u(half * std::cos(angle), half * std::sin(angle), 0.0), v(-u.y(), u.x(), 0.0);
    x.middleCols<4>(row) << middle - u - v, middle + u - v, middle + u + v, middle - u + v;
    Eigen::Matrix<int, 3, 2> facets;
    facets << 0, 0, 1, 2, 2, 3;
    tiles.push_back(world.add_body({.positions = x.middleCols<4>(row),
                                    .facets = facets,
                                    .surface = tact::Surface::sheet,
                                    .motion = fixed ? tact::Motion::fixed : tact::Motion::deformable,
                                    .margin = kMargin}));
    first_rows.push_back(row);
  }
  const tact::MotionReport& motion() {
    for (std::size_t k = 0; k < kTiles; ++k) world.set_positions(tiles[k], x.middleCols<4>(first_rows[k]));
    return world.detect_motion();
  }
};

void stop_all(Scene& scene, const Matrix3Xd& begin, double first_time) {
  scene.x = begin + std::min(1.0, 0.9 * first_time) * (scene.x - begin);
}

// [part constraints]
// Shortens ways until none leads through anything: the gap at the end becomes that at which two features meet.
void stop_what_meets(Scene& scene, const Matrix3Xd& begin) {
  const std::vector<double> inverse_masses(kMoving, 1.0);
  for (int round = 0; round < 50; ++round) {
    const auto impacts = impact_stencils(scene.motion().impacts(), scene.first_rows, begin, scene.x);
    if (impacts.empty()) return;
    for (const Stencil& stencil : impacts) {
      const auto gap_at = [&](const Matrix3Xd& x) {
        return stencil.normal.dot(difference(stencil, gather(stencil, x)));
      };
      // What began nearer than the margins stays so; a little more than these, so that rounding meets nothing.
      const double kept = std::max(stencil.gap + 0.01 * kMargin, std::min(2.0 * kMargin, gap_at(begin)));
      const double missing = kept - gap_at(scene.x);
      const double mass = effective_mass(stencil, inverse_masses);
      if (missing > 0.0 && std::isfinite(mass)) push(stencil, mass * missing * stencil.normal, inverse_masses, scene.x);
    }
  }
  stop_all(scene, begin, scene.motion().first_time());  // where they are too many: safe in any case
}
// [part constraints]

// Returns how far the first tile slid in a second, or less than 0 if anything crossed.
double play(bool by_constraints) {
  Scene scene;
  Matrix3Xd velocity = Matrix3Xd::Zero(3, scene.x.cols());
  velocity.topLeftCorner<1, 4>().setConstant(1.0);
  for (int step = 0; step < kSteps; ++step) {
    const Matrix3Xd begin = scene.x;
    velocity.bottomLeftCorner<1, kMoving>().array() -= 9.81 * kStep;
    scene.x += kStep * velocity;
    if (by_constraints)
      stop_what_meets(scene, begin);
    else
      stop_all(scene, begin, scene.motion().first_time());
    velocity = (scene.x - begin) / kStep;
    scene.motion();
    if (tact::facet_pair_count(scene.world.detect()) > 0) return -1.0;
  }
  return scene.x(0, 0) + 2.5;
}

int main() {
  const double all = play(false), each = play(true);
  std::printf("slid %.3f m with a stop of all, %.3f m with constraints\n", all, each);
  return all >= 0.0 && all < 0.5 && std::abs(each - 1.0) < 0.01 ? 0 : 1;
}

// What a solver asks in small substeps: cloth on a ball, and many sheets in a slow wave, see workloads.h.
#include <utility>
#include <vector>

#include "bench/workloads/shapes.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {

namespace {

constexpr double kSubstep = 1.0 / 720.0;  // seconds

// A sheet of vertices in rows, 1.6 m wide, over a ball that it falls on: springs, gravity, and the ball as a sphere.
class BallCloth {
 public:
  explicit BallCloth(int side) : side_(side), positions_(3, Eigen::Index{side} * side) {
    const double spacing = 1.6 / side;
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        positions_.col(at(i, j)) << (i - 0.5 * (side - 1)) * spacing, (j - 0.5 * (side - 1)) * spacing,
            kRadius + 0.05 + 0.05 * spacing * static_cast<double>((3 * i + 5 * j) % 7 - 3) / 3.0;
      }
    }
    velocities_ = Eigen::Matrix3Xd::Zero(3, positions_.cols());
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        for (const auto& [right, up] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}})
          join(i, j, right, up);
      }
    }
  }

  void step() {
    const Eigen::Matrix3Xd before = positions_;
    velocities_.row(2).array() -= 9.81 * kSubstep;
    velocities_ *= 1.0 / (1.0 + 0.8 * kSubstep);
    positions_ += kSubstep * velocities_;
    for (const Spring& spring : springs_) {
      const Eigen::Vector3d way = positions_.col(spring.b) - positions_.col(spring.a);
      const Eigen::Vector3d part = 0.25 * (1.0 - spring.length / way.norm()) * way;
      positions_.col(spring.a) += part;
      positions_.col(spring.b) -= part;
    }
    for (Eigen::Index v = 0; v < positions_.cols(); ++v) {
      const double distance = positions_.col(v).norm();
      if (distance >= kRadius + kApart) continue;
      positions_.col(v) *= (kRadius + kApart) / distance;
      positions_.col(v) += 0.4 * (before.col(v) - positions_.col(v));  // friction
    }
    velocities_ = (positions_ - before) / kSubstep;
  }
  const Eigen::Matrix3Xd& positions() const { return positions_; }

  static constexpr double kRadius = 0.4, kMargin = 0.004;  // metres

 private:
  struct Spring {
    Eigen::Index a, b;
    double length;
  };
  static constexpr double kApart = 2.0 * kMargin;  // from the ball

  Eigen::Index at(int i, int j) const { return Eigen::Index{j} * side_ + i; }
  void join(int i, int j, int right, int up) {
    if (i + right < 0 || i + right >= side_ || j + up >= side_) return;
    const Eigen::Index a = at(i, j), b = at(i + right, j + up);
    springs_.push_back({a, b, (positions_.col(a) - positions_.col(b)).norm()});
  }

  int side_;
  Eigen::Matrix3Xd positions_, velocities_;
  std::vector<Spring> springs_;
};

}  // namespace

Workload cloth_on_ball(int side, int settled, int frames) {
  BallCloth cloth(side);
  Workload workload{frames, {}};
  workload.bodies.push_back({.facets = square_sheet(side - 1, 1.0).facets,
                             .surface = Surface::sheet,
                             .margin = BallCloth::kMargin,
                             .self_contact = true});
  std::vector<Eigen::Matrix3Xd>& recorded = workload.bodies[0].frames;
  for (int step = 0; step < settled; ++step) cloth.step();
  for (int step = 0; step <= frames / 2; ++step) {
    cloth.step();
    recorded.push_back(cloth.positions());
  }
  for (int frame = frames / 2 + 1; frame < frames; ++frame) {
    const Eigen::Matrix3Xd back = recorded[static_cast<std::size_t>(frames - frame)];
    recorded.push_back(back);
  }
  const Shape ball = geodesic_sphere(side / 3);
  workload.bodies.push_back({.facets = ball.facets,
                             .surface = Surface::closed,
                             .frames = {BallCloth::kRadius * ball.positions},
                             .margin = BallCloth::kMargin});
  return workload;
}

Workload waving_sheets(int count, int side, int frames) {
  constexpr double kApart = 0.008, kMargin = 0.005;  // metres
  Workload workload{frames, {}};
  for (int k = 0; k < count; ++k) {
    WorkloadBody body{.facets = square_sheet(side - 1, 1.0).facets,
                      .surface = Surface::sheet,
                      .margin = kMargin,
                      .self_contact = true};
    for (int frame = 0; frame < frames; ++frame) {
      const double phase = 0.003 * wave(phase_of(frame, frames));
      Eigen::Matrix3Xd positions(3, Eigen::Index{side} * side);
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
          const double x = static_cast<double>(i) / (side - 1), y = static_cast<double>(j) / (side - 1);
          const double place = 0.05 * static_cast<double>((5 * i + 3 * j + k) % 7 - 3) / (3.0 * side);
          positions.col(Eigen::Index{j} * side + i) << x + place, y - place,
              kApart * k + 0.02 * wave(0.6 * x + phase) * wave(0.5 * y + 0.25 + phase) + 0.02 * place;
        }
      }
      body.frames.push_back(std::move(positions));
    }
    workload.bodies.push_back(std::move(body));
  }
  return workload;
}

}  // namespace tact::bench

// Surfaces that lie close to each other without lying on each other: what looks, from the boxes of clusters, as the
// drapes do. See workloads.h.
#include <Eigen/Geometry>
#include <cmath>

#include "bench/random.h"
#include "bench/workloads/shapes.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A mesh along the z axis, from 0 to 1, whose middle goes through at(z): its points keep their way from the axis.
template <class Place>
Matrix3Xd along(const Matrix3Xd& straight, double radius, double length, const Place& at) {
  Matrix3Xd positions(3, straight.cols());
  for (Index v = 0; v < positions.cols(); ++v) {
    const double z = straight(2, v);
    positions.col(v) << radius * straight.col(v).head<2>() + at(z), length * z;
  }
  return positions;
}

}  // namespace

Workload twisted_rods(int count, int around, int bands, int frames) {
  constexpr double kRadius = 0.02, kLength = 2.0;  // metres
  const Shape straight = rod(around, bands);
  Random random(31);
  // How far the rods are turned about each other at a height: three waves, each of a pitch of its own.
  double pitch[3], delay[3];
  for (int i = 0; i < 3; ++i) {
    pitch[i] = random.uniform(0.7, 2.5);
    delay[i] = random.uniform(0.0, 1.0);
  }
  const auto turn_at = [&](double z, double phase) {
    double turn = 3.0 * (1.0 + 0.2 * wave(phase)) * z;
    for (int i = 0; i < 3; ++i) turn += 0.25 * wave(pitch[i] * z + delay[i] + 0.2 * wave(phase));
    return turn;
  };
  Workload workload{frames, {}};
  for (int k = 0; k < count; ++k) {
    WorkloadBody& body = workload.bodies.emplace_back(WorkloadBody{.facets = straight.facets});
    for (int frame = 0; frame < frames; ++frame) {
      const double phase = phase_of(frame, frames);
      body.frames.push_back(along(straight.positions, kRadius, kLength, [&](double z) -> Vector2d {
        const double apart = 1.42 + 0.02 * wave(5.0 * z + 0.3 * k + phase);  // in radii, from the middle of all
        return apart * kRadius * on_circle(turn_at(z, phase) + static_cast<double>(k) / count);
      }));
    }
  }
  return workload;
}

Workload folding_figures(int side, int facets, int frames) {
  constexpr double kRadius = 0.12, kLength = 2.4, kSpacing = 0.5;  // metres
  const int around = static_cast<int>(std::sqrt(facets / 12.0)), bands = facets / (2 * around);
  const Shape straight = rod(around, bands);
  Random random(32);
  Workload workload{frames, {}};
  for (int k = 0; k < side * side; ++k) {
    const Vector3d place(kSpacing * (k % side), kSpacing * (k / side), random.uniform(-0.1, 0.1));
    const double lead = random.uniform(0.0, 0.2), lean = random.uniform(-0.1, 0.1);
    WorkloadBody& body = workload.bodies.emplace_back(WorkloadBody{.facets = straight.facets});
    for (int frame = 0; frame < frames; ++frame) {
      // Six limbs fold to and fro as it sinks together, until it fills the room of its neighbours.
      const double sunk = 0.5 + 0.35 * wave(phase_of(frame, frames) + 0.1 * lead);
      Matrix3Xd p = along(straight.positions, kRadius, kLength * (1.0 - 0.7 * sunk), [&](double z) -> Vector2d {
        return {0.45 * sunk * wave(3.0 * z + lead), lean * z + 0.1 * sunk * wave(2.0 * z)};
      });
      body.frames.push_back(p.colwise() + place);
    }
  }
  return workload;
}

Workload drawn_funnel(int around, int frames) {
  Workload workload = funnel(around, frames);
  // Rings of the cloth, every fourth, are drawn onto the one before: the facets between them have no area.
  for (Matrix3Xd& p : workload.bodies[0].frames) {
    for (Index first = 3 * around; first + around <= p.cols(); first += 4 * around)
      p.middleCols(first, around) = p.middleCols(first - around, around).eval();
  }
  return workload;
}

Workload slivers(int around, int frames) {
  constexpr double kRadius = 0.05, kLength = 2.0;  // metres
  const Shape straight = tube(around, 1);
  const Eigen::Quaterniond turns[2] = {{1.0, 0.2, 0.35, 0.1}, {1.0, -0.15, -0.4, 0.3}};
  Workload workload{frames, {}};
  for (int k = 0; k < 2; ++k) {
    const Eigen::Matrix3d rotation = turns[k].normalized().toRotationMatrix();
    WorkloadBody& body =
        workload.bodies.emplace_back(WorkloadBody{.facets = straight.facets, .surface = Surface::sheet});
    for (int frame = 0; frame < frames; ++frame) {
      Matrix3Xd p = along(straight.positions, kRadius, kLength, [](double) { return Vector2d::Zero().eval(); });
      p.row(2).array() -= 0.5 * kLength;
      p.row(k).array() += kRadius * wave(phase_of(frame, frames));
      body.frames.push_back(rotation * p);
    }
  }
  return workload;
}

}  // namespace tact::bench

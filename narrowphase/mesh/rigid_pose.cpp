#include "narrowphase/mesh/rigid_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

namespace {

// A coordinate of a placed vertex, and of the placed center, is off by at most four roundoffs of |R0 p.x| + |R1 p.y| +
// |R2 p.z| + |t| each, the difference of vertex and center at rest by one of their size, and its length by three: twice
// that, rounded up. A row of R is longer than 1 by 1e-9 at most. Products that vanish may be off by the least number
// besides.
constexpr double kRoundings = 4e-15;
constexpr double kLongestRow = 1.0 + 4e-9;
constexpr double kUnderflow = 64.0 * std::numeric_limits<double>::denorm_min();

double size_of(const Box& box) {
  const base::Vec3 far = farthest_from({}, box);
  return (far.x + far.y) + far.z;
}

}  // namespace

void RigidPose::begin(const PointArrays& rest, int vertex_count, const Box& rest_box) {
  set({});
  rest_box_ = rest_box;
  center_ = {};
  radius_ = 0.0;
  if (rest_box.empty()) return;
  center_ = 0.5 * rest_box.lower + 0.5 * rest_box.upper;
  for (int v = 0; v < vertex_count; ++v) {
    radius_ = std::max(radius_, length_of(Vec3{rest.x[v], rest.y[v], rest.z[v]} - center_));
  }
}

void RigidPose::set(const Pose& pose) {
  pose_ = pose;
  state_.store(kUnplaced, std::memory_order_relaxed);
}

Box RigidPose::box_at(const Pose& pose) const {
  Box box = placed(pose, rest_box_);
  if (box.empty()) return box;
  const Vec3 center = placed(pose, center_);
  const double size = size_of(rest_box_);
  for (int axis = 0; axis < 3; ++axis) {
    const double radius = radius_ * kLongestRow + kRoundings * (size + std::abs(pose.translation[axis])) + kUnderflow;
    box.lower[axis] = std::max(box.lower[axis], center[axis] - radius);
    box.upper[axis] = std::min(box.upper[axis], center[axis] + radius);
  }
  return box;
}

}  // namespace tact::narrowphase

// A triangle mesh as the simulation holds it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/base/vec3.h"

namespace tact::scenes {

using base::Vec3;

struct Mesh {
  std::vector<Vec3> positions;    // metres
  Eigen::Matrix3Xi facets{3, 0};  // indices of vertices, counter-clockwise seen from outside
};

// The same positions as tact takes them, 3 x V; nothing is copied.
inline Eigen::Map<const Eigen::Matrix3Xd> as_matrix(const std::vector<Vec3>& positions) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {positions.empty() ? nullptr : &positions.front().x, 3, static_cast<Eigen::Index>(positions.size())};
}

}  // namespace tact::scenes

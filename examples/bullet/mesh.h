// Triangle meshes for both engines: a column a vertex, a column a facet.
#pragma once

#include <Eigen/Core>

namespace example {

struct Mesh {
  Eigen::Matrix3Xd positions;  // metres
  Eigen::Matrix3Xi facets;     // counter-clockwise seen from outside
};

// The surface of a box around the origin, each side cut into `cuts` x `cuts` squares of two facets.
Mesh box(const Eigen::Vector3d& size, int cuts);
// A square cloth across z, around the origin, of `cuts` x `cuts` squares.
Mesh cloth(double side, int cuts);

}  // namespace example

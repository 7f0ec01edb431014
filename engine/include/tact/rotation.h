// Rotations from engines that compute with floats, for World::set_pose(), which takes what is orthonormal to 1e-9.
#pragma once

#include <tact/error.h>

#include <Eigen/Core>
#include <array>

namespace tact {

/// Returns the rotation nearest to a matrix that is orthonormal to 1e-5, by three Newton-Schulz steps R (3 - R^T R)
/// / 2. The answer has the same bits on every machine. Errors: not_a_rotation (it scales, shears or mirrors).
TACT_API Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

/// Returns the rotation of a quaternion x, y, z, w whose length is 1 to 1e-5; it divides by the squared length. Errors:
/// not_a_rotation.
TACT_API Eigen::Matrix3d rotation_of_quaternion(const std::array<double, 4>& quaternion);

}  // namespace tact

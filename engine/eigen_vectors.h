// The caller's vectors are Eigen's.
#pragma once

#include <Eigen/Core>

#include "engine/base/vec3.h"

namespace tact {

inline base::Vec3 from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d to_eigen(base::Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace tact

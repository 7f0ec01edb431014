// Friction at a contact point: tangents, how far it slid, and a smooth potential for implicit solvers.
#pragma once

#include <tact/solver/distance.h>

#include <Eigen/Core>
#include <cmath>

namespace tact::solver {

using Tangents = Eigen::Matrix<double, 3, 2>;  ///< two unit vectors, perpendicular to each other and a normal

/// Returns two tangents of a unit normal, which change smoothly but where its z changes sign. (T. Duff et al., Building
/// an Orthonormal Basis, Revisited, 2017.)
inline Tangents tangents(const Eigen::Vector3d& normal) {
  const double sign = std::copysign(1.0, normal.z()), a = -1.0 / (sign + normal.z()), b = normal.x() * normal.y() * a;
  Tangents result;
  result << 1.0 + sign * normal.x() * normal.x() * a, b, sign * b, sign + normal.y() * normal.y() * a,
      -sign * normal.x(), -normal.y();
  return result;
}

/// Returns the part of difference() across the normal: how b slides on a, along the two tangents.
inline Eigen::Vector2d sliding(const Stencil& stencil, const Tangents& tangents, const Corners& values) {
  return tangents.transpose() * difference(stencil, values);
}

/// Returns the potential whose gradient is a friction force of at most `limit` newtons against the way `moved` of the
/// vertices since the step began. Below `smoothing` metres, which are positive, the force grows smoothly; weights and
/// tangents stay those given. Its Hessian is positive semidefinite. (Li et al., Incremental Potential Contact, 2020,
/// section 5.)
inline Term friction_term(const Stencil& stencil, const Tangents& tangents, const Corners& moved, double limit,
                          double smoothing) {
  const Eigen::Vector2d way = sliding(stencil, tangents, moved);
  const double y = way.norm(), e = smoothing;
  const bool slips = y >= e;
  const double slope = slips ? 1.0 / y : (2.0 - y / e) / e;                               // force over way
  const double change = slips ? -1.0 / (y * y * y) : y > 0.0 ? -1.0 / (e * e * y) : 0.0;  // of the slope, over the way
  const Eigen::Vector3d first = tangents.col(0), second = tangents.col(1), along = way[0] * first + way[1] * second;
  Term term{.value = limit * (slips ? y : y * y / e - y * y * y / (3.0 * e * e) + e / 3.0)};
  for (int row = 0; row < 3 * stencil.size(); ++row) {
    const int i = row % 3;
    const double scale = limit * stencil.weights[row / 3];
    term.gradient[row] = scale * slope * along[i];
    for (int column = 0; column < 3 * stencil.size(); ++column) {
      const int j = column % 3;
      term.hessian(row, column) =
          scale * stencil.weights[column / 3] *
          (slope * (first[i] * first[j] + second[i] * second[j]) + change * along[i] * along[j]);
    }
  }
  return term;
}

}  // namespace tact::solver

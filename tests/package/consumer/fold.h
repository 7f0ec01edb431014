// A flat sheet folded twice, as one folds a letter whose ends meet: two layers everywhere.
#pragma once

#include <Eigen/Core>
#include <cmath>

/// Folds what of the 3 x V positions lies beyond `crease` metres from the plane x = 0, on either side, up and over the
/// rest; between the layers is a space of `space` metres. Waves of the sheet are flattened to a fifth.
inline void fold_ends_over(Eigen::Matrix3Xd& x, double crease, double space) {
  const double pi = std::acos(-1.0), radius = 0.5 * space, ground = x.row(2).mean();
  x.row(2).array() = ground + 0.2 * (x.row(2).array() - ground);
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const double side = x(0, i) < 0.0 ? -1.0 : 1.0, beyond = side * x(0, i) - crease, wave = x(2, i) - ground;
    if (beyond <= 0.0) continue;
    const double turn = std::min(beyond / radius, pi), rest = beyond - radius * turn;
    x(0, i) = side * (crease + (radius - wave) * std::sin(turn) - rest);
    x(2, i) = ground + radius - (radius - wave) * std::cos(turn);
  }
}

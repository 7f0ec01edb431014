// Signs that tell on which feature of a surface a point is nearest: see rounding.h.
#pragma once

#include "narrowphase/distance/rounding.h"
#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

/// The sign of a value that is certain beyond `rounding` times a size whose square is given; else 0.
inline int certain_sign(double value, double size_squared, double rounding = kSignRounding) {
  return value * value > rounding * rounding * size_squared ? (value > 0.0 ? 1 : -1) : 0;
}

/// What side_of_edge() and sign_along() do where doubles do not tell. Zero below kEqualDistance.
int fine_side_of_edge(Vec3 v, Vec3 p, Vec3 q, Vec3 third);
int fine_sign_along(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/// On which side of the edge from `p` to `q` `v` is, seen across the plane of the edge and `third`: 1 on that of
/// `third`.
inline int side_of_edge(Vec3 v, Vec3 p, Vec3 q, Vec3 third) {
  const Vec3 along = q - p, away = v - p, across = third - p;
  const double square = norm_squared(along);
  const int certain = certain_sign(dot(away, across) * square - dot(across, along) * dot(away, along),
                                   square * square * (norm_squared(away) * norm_squared(across)));
  return certain != 0 ? certain : fine_side_of_edge(v, p, q, third);
}

/// The sign of (b - a) · (d - c).
inline int sign_along(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const int certain = certain_sign(dot(b - a, d - c), norm_squared(b - a) * norm_squared(d - c));
  return certain != 0 ? certain : fine_sign_along(a, b, c, d);
}

}  // namespace tact::narrowphase

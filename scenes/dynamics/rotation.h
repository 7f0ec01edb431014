// Small matrices and rotations.
#pragma once

#include <array>
#include <cmath>

#include "scenes/dynamics/mesh.h"

namespace tact::scenes {

// A matrix of 3 x 3 by rows.
using Matrix = std::array<Vec3, 3>;

inline Vec3 operator*(const Matrix& m, Vec3 v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
inline Vec3 column(const Matrix& m, int i) { return {m[0][i], m[1][i], m[2][i]}; }
inline Matrix transposed(const Matrix& m) { return {column(m, 0), column(m, 1), column(m, 2)}; }

inline Matrix product(const Matrix& a, const Matrix& b) {
  const Matrix columns = transposed(b);
  Matrix result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = {dot(a[i], columns[0]), dot(a[i], columns[1]), dot(a[i], columns[2])};
  return result;
}

inline double determinant(const Matrix& m) { return dot(m[0], cross(m[1], m[2])); }

inline Matrix inverse(const Matrix& m) {
  const double scale = 1.0 / determinant(m);
  return transposed({scale * cross(m[1], m[2]), scale * cross(m[2], m[0]), scale * cross(m[0], m[1])});
}

// A rotation; its length is 1.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
};

inline Matrix matrix(const Quaternion& q) {
  return {Vec3{1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y - q.w * q.z), 2.0 * (q.x * q.z + q.w * q.y)},
          Vec3{2.0 * (q.x * q.y + q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z - q.w * q.x)},
          Vec3{2.0 * (q.x * q.z - q.w * q.y), 2.0 * (q.y * q.z + q.w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y)}};
}

// `q`, then turned about `by` by its length, radians.
inline Quaternion rotated(const Quaternion& q, Vec3 by) {
  const double angle = norm(by);
  if (!(angle > 0.0)) return q;
  const double s = std::sin(0.5 * angle) / angle;
  const Quaternion t{std::cos(0.5 * angle), s * by.x, s * by.y, s * by.z};
  Quaternion r{t.w * q.w - t.x * q.x - t.y * q.y - t.z * q.z, t.w * q.x + t.x * q.w + t.y * q.z - t.z * q.y,
               t.w * q.y - t.x * q.z + t.y * q.w + t.z * q.x, t.w * q.z + t.x * q.y - t.y * q.x + t.z * q.w};
  const double scale = 1.0 / std::sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
  return {scale * r.w, scale * r.x, scale * r.y, scale * r.z};
}

}  // namespace tact::scenes

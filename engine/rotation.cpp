#include <tact/rotation.h>

#include <array>
#include <cmath>

#include "engine/base/floating_point_mode.h"
#include "engine/base/text.h"

namespace tact {

namespace {

// How far a float's quaternion, matrix or product of some matrices is from a rotation: 1e-7 to 1e-6.
constexpr double kLargestSkew = 1e-5;

using Matrix = std::array<std::array<double, 3>, 3>;

// Written out, as the last bits of Eigen's products depend on how it is compiled.
Matrix product_of_transposed(const Matrix& r) {
  Matrix product{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) product[i][k] = (r[0][i] * r[0][k] + r[1][i] * r[1][k]) + r[2][i] * r[2][k];
  return product;
}

// The first entry of R^T R - 1 that is too large, or 0.
double skew(const Matrix& r) {
  const Matrix square = product_of_transposed(r);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double off = std::abs(square[i][k] - (i == k ? 1.0 : 0.0));
      if (!(off <= kLargestSkew)) return off;
    }
  return 0.0;
}

bool mirrors(const Matrix& r) {
  return !(r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
               r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]) >
           0.0);
}

// The distance from orthonormal falls from e to 3/4 e^2: 1e-5, 1e-10, 1e-20.
Matrix newton_schulz(const Matrix& r) {
  const Matrix square = product_of_transposed(r);
  Matrix next{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      next[i][k] = 0.5 * (3.0 * r[i][k] - ((r[i][0] * square[0][k] + r[i][1] * square[1][k]) + r[i][2] * square[2][k]));
  return next;
}

Eigen::Matrix3d for_caller(const Matrix& r) {
  Eigen::Matrix3d result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = r[i][k];
  return result;
}

}  // namespace

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const base::FloatingPointMode mode;
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) r[i][k] = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  if (const double off = skew(r); off != 0.0)
    throw Error(ErrorCode::not_a_rotation, "the matrix is " + base::text_of(off) + " from orthonormal, more than 1e-5");
  if (mirrors(r)) throw Error(ErrorCode::not_a_rotation, "the matrix mirrors");
  for (int step = 0; step < 3; ++step) r = newton_schulz(r);
  return for_caller(r);
}

Eigen::Matrix3d rotation_of_quaternion(const std::array<double, 4>& quaternion) {
  const base::FloatingPointMode mode;
  const auto [x, y, z, w] = quaternion;
  const double square = (x * x + y * y) + (z * z + w * w);
  if (!(std::abs(square - 1.0) <= 2.0 * kLargestSkew))
    throw Error(ErrorCode::not_a_rotation,
                "the quaternion has the squared length " + base::text_of(square) + ", not 1 to 2e-5");
  const double s = 2.0 / square;
  return for_caller({{{1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
                      {s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)},
                      {s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)}}});
}

}  // namespace tact

#include "scenes/dynamics/shape.h"

#include <cmath>
#include <numbers>

namespace tact::scenes {
namespace {

// The rotation in `m`, by turning the last one towards it. Source: M. Müller et al., A Robust Method to Extract the
// Rotational Part of Deformations, MIG 2016.
Quaternion rotation_of(const Matrix& m, Quaternion rotation) {
  constexpr int kMostTurns = 12;
  constexpr double kSmallTurn = 1e-7;  // radians
  const Matrix columns = transposed(m);
  for (int i = 0; i < kMostTurns; ++i) {
    const Matrix r = transposed(matrix(rotation));
    const Vec3 torque = cross(r[0], columns[0]) + cross(r[1], columns[1]) + cross(r[2], columns[2]);
    const double scale = std::abs(dot(r[0], columns[0]) + dot(r[1], columns[1]) + dot(r[2], columns[2]));
    if (!(scale > 0.0)) break;
    const Vec3 turn = (1.0 / scale) * torque;
    rotation = rotated(rotation, turn);
    if (norm(turn) < kSmallTurn) break;
  }
  return rotation;
}

Vec3 mean(const std::vector<Vec3>& positions) {
  Vec3 sum;
  for (const Vec3& p : positions) sum = sum + p;
  return (1.0 / static_cast<double>(positions.size())) * sum;
}

// The sum over all vertices of p rᵀ, p from `center`.
Matrix spread(const std::vector<Vec3>& positions, Vec3 center, const std::vector<Vec3>& rest) {
  Matrix sum;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const Vec3 p = positions[i] - center;
    sum[0] = sum[0] + p.x * rest[i];
    sum[1] = sum[1] + p.y * rest[i];
    sum[2] = sum[2] + p.z * rest[i];
  }
  return sum;
}

// By reference: copies go through memory in halves, and waiting for them takes longer than all the arithmetic.
const Vec3& corner(const std::vector<Vec3>& positions, const Eigen::Matrix3Xi& facets, Eigen::Index facet, int k) {
  return positions[facets(k, facet)];
}

}  // namespace

double enclosed_volume(const std::vector<Vec3>& positions, const Eigen::Matrix3Xi& facets) {
  if (positions.empty()) return 0.0;
  const Vec3 origin = positions.front();
  double sum = 0.0;
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    const Vec3& a = corner(positions, facets, f, 0);
    const Vec3& b = corner(positions, facets, f, 1);
    const Vec3& c = corner(positions, facets, f, 2);
    sum += dot(a - origin, cross(b - origin, c - origin));
  }
  return sum / 6.0;
}

VolumeKeeper::VolumeKeeper(const Mesh& rest, double bulk_modulus)
    : rest_volume_(enclosed_volume(rest.positions, rest.facets)),
      compliance_(std::abs(rest_volume_) / bulk_modulus),
      gradient_(rest.positions.size()) {}

void VolumeKeeper::solve(std::vector<Vec3>& positions, const Eigen::Matrix3Xi& facets,
                         const std::vector<double>& inverse_masses, double h) {
  gradient_.assign(positions.size(), {});
  const Vec3 origin = positions.front();
  double volume = 0.0;
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    const Vec3& a = corner(positions, facets, f, 0);
    const Vec3& b = corner(positions, facets, f, 1);
    const Vec3& c = corner(positions, facets, f, 2);
    const Vec3 third = (1.0 / 6.0) * cross(b - a, c - a);  // a third of the facet's area along its normal
    volume += dot(a - origin, third);
    for (int k = 0; k < 3; ++k) {
      Vec3& g = gradient_[facets(k, f)];
      g = g + third;
    }
  }
  double give = compliance_ / (h * h);
  for (std::size_t i = 0; i < positions.size(); ++i) give += inverse_masses[i] * norm_squared(gradient_[i]);
  if (!(give > 0.0)) return;
  const double multiplier = (rest_volume_ - volume) / give;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = positions[i] + (multiplier * inverse_masses[i]) * gradient_[i];
  }
}

ShapeKeeper::ShapeKeeper(const std::vector<Vec3>& rest, double frequency, double stretch)
    : rest_(rest), stiffness_(4.0 * std::numbers::pi * std::numbers::pi * frequency * frequency), stretch_(stretch) {
  const Vec3 center = mean(rest_);
  for (Vec3& r : rest_) r = r - center;
  inverse_spread_ = inverse(spread(rest_, {}, rest_));
}

void ShapeKeeper::solve(std::vector<Vec3>& positions, const std::vector<double>& inverse_masses, double h) {
  const Vec3 center = mean(positions);
  const Matrix moments = spread(positions, center, rest_);
  rotation_ = rotation_of(moments, rotation_);
  Matrix goal = matrix(rotation_);
  const Matrix linear = product(moments, inverse_spread_);
  // A squashed or mirrored deformation must not become the goal: only one of a sound volume is let be.
  const double volume = determinant(linear);
  const double stretch = volume > 0.1 ? stretch_ : 0.0;
  const double scale = volume > 0.1 ? 1.0 / std::cbrt(volume) : 1.0;
  for (std::size_t i = 0; i < 3; ++i) goal[i] = (1.0 - stretch) * goal[i] + (stretch * scale) * linear[i];
  const double share = 1.0 / (1.0 + 1.0 / (stiffness_ * h * h));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (inverse_masses[i] > 0.0) positions[i] = positions[i] + share * (center + goal * rest_[i] - positions[i]);
  }
}

}  // namespace tact::scenes

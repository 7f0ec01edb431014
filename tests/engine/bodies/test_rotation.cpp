// Rotations from floats become such that a world takes.
#include <gtest/gtest.h>
#include <tact/rotation.h>
#include <tact/world.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <limits>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using Quaternion = std::array<double, 4>;

double off_orthonormal(const Eigen::Matrix3d& r) {
  return (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

// A unit quaternion and its matrix, as an engine has them that computes with floats.
std::array<float, 4> float_quaternion(Random& random) {
  std::array<float, 4> q;
  float square = 0.0f;
  for (float& part : q) part = static_cast<float>(random.uniform(-1.0, 1.0)), square += part * part;
  for (float& part : q) part /= std::sqrt(square);
  return q;
}
Eigen::Matrix3f float_matrix(const std::array<float, 4>& q) {
  const auto [x, y, z, w] = q;
  Eigen::Matrix3f r;
  r << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 2 * (x * y + z * w), 1 - 2 * (x * x + z * z),
      2 * (y * z - x * w), 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
  return r;
}

TEST(Rotation, OfFloatQuaternionsAndMatricesIsTaken) {
  World world({.threads = 1});
  const Mesh ball = icosphere(1);
  const BodyId body = world.add_body({.positions = ball.positions, .facets = ball.facets, .motion = Motion::rigid});
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const std::array<float, 4> q = float_quaternion(random);
    const Eigen::Matrix3d floats = float_matrix(q).cast<double>(), nearest = nearest_rotation(floats);
    const Eigen::Matrix3d of_quaternion = rotation_of_quaternion({q[0], q[1], q[2], q[3]});
    EXPECT_THROW(world.set_pose(body, floats, Eigen::Vector3d::Zero()), Error);
    for (const Eigen::Matrix3d& r : {nearest, of_quaternion}) {
      EXPECT_LT(off_orthonormal(r), 2e-15);
      EXPECT_GT(r.determinant(), 0.0);
      EXPECT_LT((r - floats).cwiseAbs().maxCoeff(), 1e-6);
      world.set_pose(body, r, Eigen::Vector3d::Zero());
    }
  }
}

// Nearest in the sense of the polar decomposition, by singular values.
TEST(Rotation, IsTheNearestOne) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Rotation exact = random.rotation();
    Eigen::Matrix3d r;
    for (int k = 0; k < 3; ++k) r.row(k) << exact.row[k].x, exact.row[k].y, exact.row[k].z;
    for (int k = 0; k < 9; ++k) r.data()[k] += random.uniform(-2e-6, 2e-6);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
    EXPECT_LT((nearest_rotation(r) - svd.matrixU() * svd.matrixV().transpose()).cwiseAbs().maxCoeff(), 2e-15);
  }
}

TEST(Rotation, OfKnownQuaternions) {
  Eigen::Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const double half = std::sqrt(0.5);
  EXPECT_LT((rotation_of_quaternion({0, 0, half, half}) - quarter).norm(), 1e-15);
  EXPECT_EQ(rotation_of_quaternion({0, 0, 0, 1}), Eigen::Matrix3d::Identity());
  EXPECT_EQ(rotation_of_quaternion({0, 0, 0, -1}), Eigen::Matrix3d::Identity());
  EXPECT_EQ(nearest_rotation(quarter), quarter) << "what is a rotation stays";
}

TEST(Rotation, ThatIsNoneIsRefused) {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d mirror = one, sheared = one, broken = one;
  mirror(2, 2) = -1.0;
  sheared(0, 1) = 2e-5;
  broken(1, 0) = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Matrix3d& r : {mirror, sheared, broken, Eigen::Matrix3d(2.0 * one), Eigen::Matrix3d(0.0 * one)}) {
    try {
      nearest_rotation(r);
      ADD_FAILURE() << r;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::not_a_rotation);
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Quaternion& q : {Quaternion{0, 0, 0, 0}, {0, 0, 0, 2}, {0, 0, nan, 1}, {0, 0, 0, 1.0 + 2e-5}})
    EXPECT_THROW(rotation_of_quaternion(q), Error);
}

}  // namespace
}  // namespace tact::tests

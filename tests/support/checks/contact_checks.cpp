#include "tests/support/checks/contact_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/checks/detection.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::tests {
namespace {

// The points that count, about the first vertex of `origin`: brute force is as coarse as the largest coordinate.
std::vector<Vec3> near_points(const Mesh& mesh, const Mesh& origin) {
  return used_points(translated(mesh, -origin.position(0)));
}

}  // namespace

::testing::AssertionResult is_sound(const Contact& contact, const Mesh& a, const Mesh& b) {
  const std::vector<Vec3> points_a = near_points(a, a), points_b = near_points(b, a);
  const double size = extent(a) + extent(b), tolerance = 1e-13 * size;
  const double far = std::max(a.positions.cwiseAbs().maxCoeff(), b.positions.cwiseAbs().maxCoeff());
  const Vec3 n = from_eigen(contact.direction);
  const auto height = static_cast<double>(minkowski_height(points_a, points_b, n));
  if (contact.limit_reached) return ::testing::AssertionFailure() << "a limit was reached";
  if (std::abs(norm(n) - 1.0) > 4e-16) return ::testing::AssertionFailure() << "length " << norm(n);
  if (!(contact.depth >= 0.0)) return ::testing::AssertionFailure() << "depth " << contact.depth;
  if (std::abs(std::max(height, 0.0) - contact.depth) > tolerance) {
    return ::testing::AssertionFailure() << "depth " << contact.depth << ", but the hulls overlap by " << height;
  }
  if (std::abs(contact.plane_a - contact.plane_b - contact.depth) > tolerance + 4e-16 * far) {
    return ::testing::AssertionFailure() << "planes " << contact.plane_a << " and " << contact.plane_b;
  }
  double reach_a = -HUGE_VAL, reach_b = HUGE_VAL;
  for (const Vec3& p : used_points(a)) reach_a = std::max(reach_a, dot(n, p));
  for (const Vec3& p : used_points(b)) reach_b = std::min(reach_b, dot(n, p));
  if (std::abs(contact.plane_a - reach_a) > tolerance + 1e-15 * far) {
    return ::testing::AssertionFailure() << "plane_a is " << contact.plane_a << ", a reaches to " << reach_a;
  }
  if (std::abs(contact.plane_b - reach_b) > tolerance + 1e-15 * far) {
    return ::testing::AssertionFailure() << "plane_b is " << contact.plane_b << ", b reaches to " << reach_b;
  }
  if (!is_local_minimum(points_a, points_b, n, tolerance)) {
    return ::testing::AssertionFailure() << "not a local minimum: " << contact.direction.transpose();
  }
  return ::testing::AssertionSuccess();
}

std::optional<Contact> contact_of(const Mesh& a, const Mesh& b) {
  World world;
  add_bodies(world, std::array{a, b});
  const auto contacts = world.detect().contacts();
  if (contacts.empty()) return std::nullopt;
  return contacts[0];
}

}  // namespace tact::tests

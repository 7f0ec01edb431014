#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "narrowphase/distance/signs.h"
#include "narrowphase/numeric/wide_vector.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

constexpr int kUnit = 900;  // coordinates are multiples of 2^(900 - 1075)

WideVector<4> exact_difference(Vec3 p, Vec3 q) { return in_units<3>(p, kUnit) - in_units<3>(q, kUnit); }

// Of a value that is so large beside its size; nothing where the band of equal distances is too near.
std::optional<int> sign_beside(double value, double size) {
  if (std::abs(std::abs(value) - kEqualDistance * size) < 0x1p-66 * size) return {};
  return std::abs(value) < kEqualDistance * size ? 0 : value > 0.0 ? 1 : -1;
}

std::optional<int> exact_side_of_edge(Vec3 v, Vec3 p, Vec3 q, Vec3 third) {
  const auto along = exact_difference(q, p), away = exact_difference(v, p), across = exact_difference(third, p);
  const auto value = dot(away, across) * dot(along, along) - dot(across, along) * dot(away, along);
  return sign_beside(value.times_power(4 * (1075 - kUnit)), norm_squared(q - p) * norm(v - p) * norm(third - p));
}

std::optional<int> exact_sign_along(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto value = dot(exact_difference(b, a), exact_difference(d, c));
  return sign_beside(value.times_power(2 * (1075 - kUnit)), norm(b - a) * norm(d - c));
}

// Points on the border but for so little that doubles take it for zero.
TEST(DistanceSigns, AreExactWhereDoublesDoNotTell) {
  Random random(4);
  int fine = 0, equal = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = random.in_cube(1.0), along = random.in_cube(1.0);
    const Vec3 across = normalized(cross(along, random.in_cube(1.0))), up = normalized(cross(along, across));
    const double off = std::ldexp(random.uniform(-1.0, 1.0), -random.below(80));
    const Vec3 q = p + along, third = p + across + 0.3 * along, v = p + up + 0.4 * along + off * across;
    const std::optional<int> side = exact_side_of_edge(v, p, q, third), sign = exact_sign_along(p, v, p, third);
    if (std::abs(off) < kSignRounding && side && *side != 0) ++fine;
    if (side == 0) ++equal;
    if (side) {
      EXPECT_EQ(side_of_edge(v, p, q, third), *side) << i;
    }
    if (sign) {
      EXPECT_EQ(sign_along(p, v, p, third), *sign) << i;
    }
  }
  EXPECT_GT(fine, 5'000);
  EXPECT_GT(equal, 300);
}

// A point that is exactly on the border is on neither side, nor is one at an edge without length.
TEST(DistanceSigns, AreZeroOnTheBorder) {
  for (const double unit : {1.0, 0.1, 1e-100, 1e100}) {
    const Vec3 p{}, q{3.0 * unit, 0.0, 0.0}, third{unit, 2.0 * unit, 0.0}, above{unit, 0.0, unit};
    EXPECT_EQ(side_of_edge(above, p, q, third), 0) << unit;
    EXPECT_EQ(side_of_edge({unit, 0.1 * unit, unit}, p, q, third), 1) << unit;
    EXPECT_EQ(side_of_edge({unit, -0.1 * unit, unit}, p, q, third), -1) << unit;
    EXPECT_EQ(side_of_edge(above, p, p, third), 0) << unit;
    EXPECT_EQ(sign_along(p, q, p, {0.0, unit, unit}), 0) << unit;
    EXPECT_EQ(sign_along(p, q, p, {1e-16 * unit, unit, unit}), 1) << unit;
  }
}

}  // namespace
}  // namespace tact::narrowphase

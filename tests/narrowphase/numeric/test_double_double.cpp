#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {
namespace {

Vec3 cross_of_sides(Vec3 p, Vec3 q, Vec3 r) {
  return double_double_cross(double_double_difference(q, p), double_double_difference(r, p));
}

}  // namespace

TEST(DoubleDoubleVec3, DifferenceLosesNothing) {
  const auto d = double_double_difference({1.0, 1e16, 0x1p-60}, {0x1p-80, 1.0, 1.0});
  EXPECT_EQ(heads(d), (Vec3{1.0, 1e16, -1.0}));
  EXPECT_EQ((Vec3{d.x.tail, d.y.tail, d.z.tail}), (Vec3{-0x1p-80, -1.0, 0x1p-60}));
}

// Coordinates of 50 bits on a grid: 128-bit integers tell the cross product exactly.
TEST(DoubleDoubleVec3, CrossOfNearlyParallelSidesHasRightDigits) {
  __extension__ using Integer = __int128;
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> coordinate(-(std::int64_t{1} << 50), std::int64_t{1} << 50), nudge(-3, 3);
  for (int i = 0; i < 20000; ++i) {
    std::int64_t p[3], e[3], f[3];
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = coordinate(random);
      e[axis] = coordinate(random) / 2;
      f[axis] = e[axis] / 2 * (i % 3) + nudge(random) * (std::int64_t{1} << (i % 40));
    }
    const auto point = [&](const std::int64_t* d) {
      return Vec3{static_cast<double>(p[0] + d[0]), static_cast<double>(p[1] + d[1]), static_cast<double>(p[2] + d[2])};
    };
    const std::int64_t zero[3] = {0, 0, 0};
    const Vec3 n = cross_of_sides(point(zero), point(e), point(f));
    for (int axis = 0; axis < 3; ++axis) {
      const int j = (axis + 1) % 3, k = (axis + 2) % 3;
      const double exact = static_cast<double>(Integer{e[j]} * f[k] - Integer{e[k]} * f[j]);
      EXPECT_NEAR(n[axis], exact, 0x1p-52 * std::abs(exact)) << "case " << i;
    }
  }
}

TEST(DoubleDoubleVec3, CollinearPointsHaveNoCross) {
  EXPECT_EQ(cross_of_sides({0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, {4, 5, 6}), (Vec3{}));
  EXPECT_EQ(cross_of_sides({1, 2, 3}, {2, 4, 6}, {-5, -10, -15}), (Vec3{}));
}

TEST(DoubleDoubleVec3, UnitVectorsOfAnySize) {
  for (const int exponent : {-1070, -600, 0, 600, 1020}) {
    const Vec3 v{std::ldexp(3.0, exponent), 0.0, std::ldexp(-4.0, exponent)};
    EXPECT_LT(norm(unit_vector(v) - Vec3{0.6, 0.0, -0.8}), 2e-16) << exponent;
  }
}

}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "narrowphase/numeric/angle.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

using base::Vec3;

TEST(Angle, IsThatOfTheLibraryButForRounding) {
  tests::Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = random.in_cube(1.0);
    const double near = std::pow(10.0, random.uniform(-12.0, 0.0));
    const Vec3 q = i % 3 == 0 ? random.in_cube(1.0) : (i % 3 == 1 ? 1.0 : -1.0) * p + near * random.in_cube(1.0);
    EXPECT_NEAR(angle_between(p, q), std::atan2(norm(cross(p, q)), dot(p, q)), 0x1p-48) << i;
  }
}

TEST(Angle, OfRoundOnes) {
  const Vec3 x{2.0, 0.0, 0.0}, y{0.0, 3.0, 0.0};
  EXPECT_EQ(angle_between(x, x), 0.0);
  EXPECT_NEAR(angle_between(x, y), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(angle_between(x, x + 2.0 / 3.0 * y), std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(angle_between(x, -x), std::numbers::pi);
  EXPECT_EQ(angle_between(x, {}), 0.0);
}

}  // namespace
}  // namespace tact::narrowphase

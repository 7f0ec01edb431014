#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/triangles/lattice.h"

namespace tact::narrowphase {
namespace {

constexpr BoxBounds kUnitBox{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};

BoxBounds moved_and_scaled(const BoxBounds& box, double by, double scale) {
  BoxBounds result;
  for (int axis = 0; axis < 3; ++axis) {
    result.lower[axis] = scale * (box.lower[axis] + by);
    result.upper[axis] = scale * (box.upper[axis] + by);
  }
  return result;
}

// The longest side is 1, next below the power of two 2: 2^16 steps along it.
TEST(Lattice, InDoublesHasTwoToTheSixteenStepsAlongAPowerOfTwo) {
  EXPECT_EQ(finest_lattice_in_doubles(kUnitBox).step, 0x1p-15);
  EXPECT_EQ(finest_lattice_in_doubles(moved_and_scaled(kUnitBox, 0.0, 0.75)).step, 0x1p-16);
  for (const double scale : {0x1p-140, 0x1p140})
    EXPECT_EQ(finest_lattice_in_doubles(moved_and_scaled(kUnitBox, 0.0, scale)).step, 0x1p-15 * scale);
}

// Six times the product of the sides, in steps, is a whole number that a float holds.
TEST(Lattice, InFloatsLeavesTheLargestDeterminantExact) {
  for (const double flatness : {1.0, 0.125, 0x1p-8, 0.0}) {
    const BoxBounds box{{0.0, 0.0, 0.0}, {1.0, 0.75, flatness}};
    const double step = finest_lattice_in_floats(box).step;
    ASSERT_GT(step, 0.0);
    double product = 6.0, finer = 6.0;
    for (int axis = 0; axis < 3; ++axis) {
      product *= std::fmax(box.upper[axis] / step, 1.0);
      finer *= std::fmax(2.0 * box.upper[axis] / step, 1.0);
    }
    EXPECT_LE(product, 0x1p24) << flatness;
    EXPECT_LE(1.0 / step, 0x1p10) << flatness;
    EXPECT_TRUE(finer > 0x1p24 || 2.0 / step > 0x1p9) << flatness << ": a finer lattice would do";
  }
}

// The origin is a point of the lattice below or above the box's corner by at most half a step, the scale one step a
// cell.
TEST(Lattice, GridStartsAtAPointOfTheLattice) {
  const Lattice lattice = finest_lattice_in_doubles(moved_and_scaled(kUnitBox, 0x1.23456789abcdep3, 1.0));
  ASSERT_GT(lattice.step, 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = lattice.grid.origin[axis] / lattice.step;
    EXPECT_EQ(steps, std::nearbyint(steps));
    EXPECT_LE(std::fabs(lattice.grid.origin[axis] - 0x1.23456789abcdep3), 0.5 * lattice.step);
    EXPECT_EQ(lattice.grid.scale[axis] * lattice.step, 1.0);
  }
}

TEST(Lattice, IsMissingWhereBoxesHaveNoSizeOrLieTooFarAway) {
  const BoxBounds point{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
  EXPECT_EQ(finest_lattice_in_doubles(point).step, 0.0);
  EXPECT_EQ(finest_lattice_in_floats(point).step, 0.0);
  EXPECT_EQ(finest_lattice_in_doubles(moved_and_scaled(kUnitBox, 0.0, 0x1p200)).step, 0.0);
  EXPECT_EQ(finest_lattice_in_doubles(moved_and_scaled(kUnitBox, 0x1p40, 1.0)).step, 0.0);
  EXPECT_GT(finest_lattice_in_doubles(moved_and_scaled(kUnitBox, 0x1p30, 1.0)).step, 0.0);
}

}  // namespace
}  // namespace tact::narrowphase

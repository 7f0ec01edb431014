#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/box.h"

namespace {

using tact::base::Box;
using tact::base::contains;
using tact::base::extended;
using tact::base::intersection;
using tact::base::merged;
using tact::base::overlaps;
using tact::base::Vec3;

constexpr Box kUnit{{0, 0, 0}, {1, 1, 1}};

TEST(Box, WithoutPointsIsEmptyAndOverlapsNothing) {
  EXPECT_TRUE(Box{}.empty());
  EXPECT_FALSE(overlaps(Box{}, Box{}));
  EXPECT_FALSE(overlaps(Box{}, kUnit));
  EXPECT_FALSE(overlaps(kUnit, Box{}));
  EXPECT_EQ(merged(Box{}, kUnit), kUnit);
}

TEST(Box, ExtendedByAPointHoldsThatPoint) {
  const Vec3 p{-3, 0.5, 7};
  EXPECT_EQ(extended(Box{}, p), (Box{p, p}));
  EXPECT_FALSE(extended(Box{}, p).empty());
  EXPECT_EQ(extended(kUnit, p), (Box{{-3, 0, 0}, {1, 1, 7}}));
}

// Boxes are closed: touching in a face, an edge or a corner counts, a gap of one ulp does not, whatever the axis.
TEST(Box, OverlapsUpToTheLastBit) {
  const double beyond = std::nextafter(1.0, 2.0);
  for (int axis = 0; axis < 3; ++axis) {
    Box other{{0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}};
    other.lower[axis] = 1.0;
    other.upper[axis] = 2.0;
    EXPECT_TRUE(overlaps(kUnit, other) && overlaps(other, kUnit)) << "axis " << axis;
    other.lower[axis] = beyond;
    EXPECT_FALSE(overlaps(kUnit, other) || overlaps(other, kUnit)) << "axis " << axis;
  }
  EXPECT_TRUE(overlaps(kUnit, Box{{1, 1, 1}, {2, 2, 2}}));
}

TEST(Box, IntersectionIsEmptyWhereBoxesAreApart) {
  EXPECT_EQ(intersection(kUnit, Box{{0.5, -1, 1}, {2, 2, 2}}), (Box{{0.5, 0, 1}, {1, 1, 1}}));
  for (int axis = 0; axis < 3; ++axis) {
    Box apart = kUnit;
    apart.lower[axis] = 2.0;
    apart.upper[axis] = 3.0;
    EXPECT_FALSE(overlaps(intersection(kUnit, apart), kUnit)) << "axis " << axis;
  }
}

TEST(Box, ContainsItsBorder) {
  EXPECT_TRUE(contains(kUnit, {0, 1, 0.5}));
  EXPECT_FALSE(contains(kUnit, {0, std::nextafter(1.0, 2.0), 0.5}));
  EXPECT_FALSE(contains(Box{}, {0, 0, 0}));
}

}  // namespace

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "narrowphase/hull/kdop.h"
#include "tests/support/generators/point_soup.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

using base::Vec3;
using tests::along_diagonals;
using tests::PointSoup;

// Coordinates are whole numbers near 2^53, so that every other sum rounds, and integers tell the truth.
TEST(SeparatingDiagonal, SeparatesBeforeRounding) {
  tests::Random random(2);
  int separated = 0, touching = 0;
  for (int repeat = 0; repeat < 20'000; ++repeat) {
    constexpr std::int64_t kLarge = std::int64_t{1} << 53;
    std::array<PointSoup, 2> points;
    std::array<std::array<std::int64_t, 6>, 2> lower, upper;
    const int diagonal = random.below(6), first = (diagonal % 3 + 1) % 3, second = (diagonal % 3 + 2) % 3;
    for (std::size_t body = 0; body < 2; ++body) {
      lower[body].fill(std::numeric_limits<std::int64_t>::max());
      upper[body].fill(std::numeric_limits<std::int64_t>::min());
      for (int i = 0; i < 3; ++i) {
        // In the plane across the diagonal, and the second body a few units beyond, or not.
        std::array<std::int64_t, 3> p{random.below(9), random.below(9), random.below(9)};
        const std::int64_t slide = kLarge - 100 - random.below(9);
        p[first] = slide + (body == 1 ? random.below(5) : 0);
        p[second] = (diagonal < 3 ? 1 : -1) * (kLarge - slide) + slide / 2;
        points[body].add(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
        const auto reach = along_diagonals(p[0], p[1], p[2]);
        for (std::size_t k = 0; k < 6; ++k) {
          lower[body][k] = std::min(lower[body][k], reach[k]);
          upper[body][k] = std::max(upper[body][k], reach[k]);
        }
      }
    }
    const Kdop a = scalar_kernels()->kdop(points[0].arrays(), 3);
    const Kdop b = scalar_kernels()->kdop(points[1].arrays(), 3);
    const int found = separating_diagonal(a, b, 0.0);
    EXPECT_EQ(separating_diagonal(b, a, 0.0) != 0, found != 0);
    if (found == 0) {
      for (std::size_t k = 0; k < 6; ++k) touching += upper[0][k] == lower[1][k] || upper[1][k] == lower[0][k];
      continue;
    }
    ++separated;
    const auto k = static_cast<std::size_t>(std::abs(found) - 1);
    ASSERT_TRUE(found > 0 ? upper[0][k] < lower[1][k] : upper[1][k] < lower[0][k]) << "repeat " << repeat;
    ASSERT_TRUE(separates(static_cast<SeparatingDiagonal>(found), a, b, 0.0));
    ASSERT_FALSE(separates(static_cast<SeparatingDiagonal>(-found), a, b, 0.0));
  }
  EXPECT_GT(separated, 1000);
  EXPECT_GT(touching, 1000);
}

// Two bodies of one point each, one beyond the other along a diagonal, turned and told apart by every one of them.
TEST(SeparatingDiagonal, TheWidestGapPartsFromAToB) {
  for (int first = 0; first < 3; ++first) {
    for (int second = 0; second < 3; ++second) {
      for (const double sign : {1.0, -1.0}) {
        for (const double along : {1.0, -1.0}) {
          if (first == second) continue;
          Vec3 offset;
          offset[first] = along;
          offset[second] = along * sign;
          PointSoup a, b;
          a.add(5, 6, 7);
          b.add(5 + offset.x, 6 + offset.y, 7 + offset.z);
          const SeparatingDiagonal diagonal =
              separating_diagonal(scalar_kernels()->kdop(a.arrays(), 1), scalar_kernels()->kdop(b.arrays(), 1), 0.0);
          ASSERT_NE(diagonal, 0);
          const auto reaches = [&](double reach) {
            const Kdop of_a = scalar_kernels()->kdop(a.arrays(), 1), of_b = scalar_kernels()->kdop(b.arrays(), 1);
            EXPECT_EQ(separating_diagonal(of_a, of_b, reach) == 0, !separates(diagonal, of_a, of_b, reach));
            return !separates(diagonal, of_a, of_b, reach);
          };
          EXPECT_FALSE(reaches(std::sqrt(2.0) - 1e-10));
          EXPECT_TRUE(reaches(std::sqrt(2.0)));  // a few roundings are to spare
          EXPECT_TRUE(reaches(1.5));
          const Vec3 n = direction_of(diagonal);
          EXPECT_NEAR(dot(n, n), 1.0, 1e-15);
          EXPECT_NEAR(dot(n, offset), std::sqrt(2.0), 1e-15);
        }
      }
    }
  }
}

TEST(SeparatingDiagonal, IsNoneForBodiesThatTouch) {
  PointSoup a, b;
  a.add(0, 0, 0);
  a.add(1, 0, 0);
  b.add(1, 0, 0);
  b.add(2, 0, 0);
  EXPECT_EQ(separating_diagonal(scalar_kernels()->kdop(a.arrays(), 2), scalar_kernels()->kdop(b.arrays(), 2), 0.0), 0);
  for (SeparatingDiagonal diagonal = -6; diagonal <= 6; ++diagonal) {
    EXPECT_FALSE(
        separates(diagonal, scalar_kernels()->kdop(a.arrays(), 2), scalar_kernels()->kdop(b.arrays(), 2), 0.0));
  }
}

}  // namespace
}  // namespace tact::narrowphase

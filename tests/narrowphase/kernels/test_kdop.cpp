#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/point_soup.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

using tests::PointSoup;

TEST(Kdop, BoundsEveryPoint) {
  tests::Random random(1);
  for (int count = 1; count <= 70; ++count) {
    PointSoup points;
    Kdop expected;
    std::ranges::fill(expected.lower, std::numeric_limits<double>::infinity());
    std::ranges::fill(expected.upper, -std::numeric_limits<double>::infinity());
    for (int i = 0; i < count; ++i) {
      const auto coordinate = [&] { return random.chance(0.2) ? 0.0 * (random.below(3) - 1) : random.uniform(-9, 9); };
      const double x = coordinate(), y = coordinate(), z = coordinate();
      points.add(x, y, z);
      const auto reach = tests::along_diagonals(x, y, z);
      for (std::size_t k = 0; k < kDiagonals; ++k) {
        expected.lower[k] = std::min(expected.lower[k], reach[k]);
        expected.upper[k] = std::max(expected.upper[k], reach[k]);
      }
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      const Kdop bounds = kernels->kdop(points.arrays(), count);
      for (int k = 0; k < kDiagonals; ++k) {
        EXPECT_EQ(bounds.lower[k], expected.lower[k]) << kernels->name << " of " << count << " points";
        EXPECT_EQ(bounds.upper[k], expected.upper[k]) << kernels->name << " of " << count << " points";
        EXPECT_FALSE(bounds.lower[k] == 0.0 && std::signbit(bounds.lower[k])) << kernels->name;
        EXPECT_FALSE(bounds.upper[k] == 0.0 && std::signbit(bounds.upper[k])) << kernels->name;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase

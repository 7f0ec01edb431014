#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "narrowphase/motion/opening_walls.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using narrowphase::common_direction, base::normalized;

bool all_forward(Vec3 direction, const std::vector<Vec3>& units) {
  return std::ranges::all_of(units, [&](Vec3 unit) { return dot(direction, unit) > 0.0; });
}

// Between an edge and a side of a facet that open by a thousandth; most ways are on one side.
TEST(CommonDirection, IsFoundInANarrowWedge) {
  std::vector<Vec3> units(6, normalized(Vec3{0.001, 1.0, 0.2}));
  units.push_back(normalized(Vec3{0.001, -1.0, -0.2}));
  EXPECT_TRUE(all_forward(common_direction(units), units));
}

TEST(CommonDirection, IsFoundWhereverThereIsARoomyOne) {
  Random random(3);
  for (int round = 0; round < 2000; ++round) {
    const Vec3 along = random.direction();
    std::vector<Vec3> units;
    while (units.size() < 7) {
      if (const Vec3 unit = random.direction(); dot(unit, along) > 1e-6) units.push_back(unit);
    }
    EXPECT_TRUE(all_forward(common_direction(units), units)) << round;
  }
}

TEST(CommonDirection, IsZeroWhereThereIsNone) {
  const std::vector<Vec3> units{{1, 0, 0}, normalized({-1, 1, 0}), normalized({-1, -1, 1}), normalized({-1, -1, -1})};
  EXPECT_EQ(common_direction(units), Vec3{});
  EXPECT_FALSE(all_forward(common_direction(std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}}), {{1, 0, 0}, {-1, 0, 0}}));
}

}  // namespace
}  // namespace tact::tests

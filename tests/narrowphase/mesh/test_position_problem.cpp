#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "narrowphase/mesh/position_problem.h"
#include "tests/support/generators/bodies.h"

namespace tact::narrowphase {
namespace {

TEST(FindPositionProblem, NamesTheFirst) {
  tests::Mesh mesh = tests::box({0, 0, 0}, {1, 1, 1});
  const auto look = [&] { return find_position_problem(mesh.positions.data(), 8, 0x1p300); };
  EXPECT_EQ(look().kind, PositionProblem::none);
  mesh.positions(2, 5) = -0x1.1p300;
  EXPECT_EQ(look().kind, PositionProblem::out_of_range);
  EXPECT_EQ(look().value, -0x1.1p300);
  mesh.positions(1, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(look().kind, PositionProblem::non_finite);
  EXPECT_EQ(look().source_vertex, 5);
  EXPECT_EQ(look().axis, 1);
  EXPECT_TRUE(std::isnan(look().value));
}

}  // namespace
}  // namespace tact::narrowphase

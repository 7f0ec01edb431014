// A few cases of every kind of tact-bench stability, whose counts of failures must be zero; and that it can count.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cctype>
#include <ostream>
#include <string>
#include <utility>

#include "bench/stability/check.h"
#include "bench/stability/shapes.h"

namespace tact::bench {

void PrintTo(const StabilityKind& kind, std::ostream* out) { *out << kind.name; }

namespace {

class StabilityOfKind : public ::testing::TestWithParam<StabilityKind> {};

TEST_P(StabilityOfKind, HasNoFailures) {
  const std::uint64_t cases = GetParam().rarity > 1 ? 1 : 8;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    const StabilityFailures failures = check_stability(GetParam().make(seed));
    EXPECT_EQ(failures.sum(), 0) << GetParam().name << ", seed " << seed << ": " << failures.first;
  }
}

std::string identifier(const ::testing::TestParamInfo<StabilityKind>& instance) {
  std::string name = instance.param.name;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, StabilityOfKind,
                         ::testing::ValuesIn(stability_kinds().begin(), stability_kinds().end()), identifier);

TEST(Stability, CountsHullsThatAreWronglyApart) {
  StabilityCase c{{{ball_shape(0)}, {moved(ball_shape(0), {5.0, 0.0, 0.0})}}};
  c.hulls_overlap = true;  // a lie
  EXPECT_GT(check_stability(c).hulls, 0);
}

TEST(Stability, CountsExceptions) {
  StabilityCase c{{{ball_shape(0)}, {ball_shape(0)}}};
  c.bodies[1].mesh.facets(0, 0) = 99;
  EXPECT_GT(check_stability(c).exceptions, 0);
}

TEST(Stability, CountsBadDataThatIsTaken) {
  StabilityCase c{{{ball_shape(0)}, {ball_shape(0)}}};
  c.refused = true;  // a lie
  EXPECT_EQ(check_stability(c).exceptions, 2);
}

TEST(StabilityShapes, SolidsAreClosedAndRightSideOut) {
  const std::pair<Mesh, double> solids[] = {{box_shape({0, 0, 0}, {1, 2, 3}), 6.0}, {ball_shape(3), 4.15}};
  for (const auto& [mesh, volume] : solids) {
    double sum = 0.0;
    for (const auto f : mesh.facets.colwise()) {
      const Eigen::Matrix3d corners = mesh.positions(Eigen::all, f);
      sum += corners.determinant() / 6.0;
    }
    EXPECT_NEAR(sum, volume, 0.01 * volume);
  }
}

TEST(MinkowskiFaces, OfTwoCubesAreThoseOfTheirSum) {
  const Mesh cube = box_shape({-1, -1, -1}, {1, 1, 1});
  const MinkowskiFaces faces(cube, cube);
  const auto smallest = faces.smallest({1.5, 0.25, 0.0}, 1e-12);
  EXPECT_DOUBLE_EQ(smallest.height, 0.5);
  for (const Eigen::Vector3d& n : smallest.directions) EXPECT_LT((n - Eigen::Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT(faces.smallest({2.5, 0.0, 0.0}, 0.0).height, 0.0);
}

}  // namespace
}  // namespace tact::bench

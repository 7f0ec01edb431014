// Positions and facets are taken from whatever is a matrix.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/world_of_three.h"
#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::tests {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A row-major matrix is copied, and a block of a larger one is read where it is.
TEST(World, TakesRowMajorMatricesAndBlocks) {
  World world;
  const Mesh mesh = icosphere(1), other = translated(mesh, {1.2, 0.0, 0.0});
  const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> rows = mesh.positions;
  Eigen::MatrixXd wide(3, 2 * other.vertex_count());
  wide.rightCols(other.vertex_count()) = other.positions;
  const BodyId a = world.add_body({.positions = rows, .facets = mesh.facets});
  const BodyId b = world.add_body({.positions = wide.rightCols(other.vertex_count()), .facets = mesh.facets});
  const std::array ids = {a, b};
  EXPECT_TRUE(
      same_meeting_bodies(meeting_bodies_by_oracle(std::array{mesh, other}), meeting_bodies(world.detect(), ids)));
}

// A matrix that is part of a taller one has gaps between its columns.
TEST(World, TakesPositionsWithGapsBetweenColumns) {
  World world;
  const Mesh mesh = icosphere(1), other = translated(mesh, {1.2, 0.0, 0.0});
  Eigen::MatrixXd tall = Eigen::MatrixXd::Constant(5, mesh.vertex_count(), kNan);
  tall.topRows(3) = mesh.positions;
  Eigen::MatrixXi tall_facets = Eigen::MatrixXi::Constant(4, mesh.facet_count(), -7);
  tall_facets.bottomRows(3) = mesh.facets;
  const BodyId a = world.add_body({.positions = tall.topRows(3), .facets = tall_facets.bottomRows(3)});
  const std::array ids = {a, world.add_body(definition(other))};
  EXPECT_TRUE(
      same_meeting_bodies(meeting_bodies_by_oracle(std::array{mesh, other}), meeting_bodies(world.detect(), ids)));
}

// What is no matrix of whole columns in the caller's memory is held by the update and its copies.
TEST(World, UpdatesOutliveWhatTheyWereMadeFrom) {
  World world;
  const Mesh mesh = icosphere(1);
  const std::array ids = {world.add_body(definition(mesh)), world.add_body(definition(mesh)),
                          world.add_body(definition(mesh)), world.add_body(definition(mesh)),
                          world.add_body(definition(mesh))};
  std::vector<PositionsUpdate> updates;
  std::vector<Mesh> expected;
  const auto at = [&](double x) { return translated(mesh, {x, 0.0, 0.0}); };
  {
    const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> rows = at(1.0).positions;
    const Eigen::Matrix3Xf narrow = at(2.0).positions.cast<float>();
    const Eigen::Matrix3Xd half = 0.5 * at(3.0).positions;
    updates.push_back({ids[0], rows});
    updates.push_back({ids[1], narrow});
    updates.push_back({ids[2], 2.0 * half});
    updates.push_back({ids[3], at(4.0).positions});
    updates.push_back({ids[4], Eigen::Ref<const Eigen::Matrix3Xd>(2.0 * at(2.5).positions.array() - 5.0)});
    expected = {at(1.0), at(2.0), at(3.0), at(4.0), at(2.5)};
    expected[4].positions = 2.0 * expected[4].positions.array() - 5.0;
    expected[1].positions = narrow.cast<double>();
  }
  const std::vector<PositionsUpdate> copies = updates;
  updates.clear();
  world.set_positions(copies);
  EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(expected), meeting_bodies(world.detect(), ids)));
}

// Classes derived from a matrix, whole numbers, vectors and nothing at all.
TEST(World, TakesWhateverIsAMatrix) {
  struct Points : Eigen::Matrix3Xd {
    using Eigen::Matrix3Xd::Matrix3Xd;
  };
  Points points(3, 4);
  points << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(Positions(points).data(), points.data());
  const Eigen::Matrix<int, 3, 4> whole = points.cast<int>();
  const Positions positions = whole;
  EXPECT_TRUE((Eigen::Map<const Eigen::Matrix3Xd>(positions.data(), 3, 4) == points));
  EXPECT_EQ(Positions(Eigen::Vector3d(1, 2, 3)).cols(), 1);
  EXPECT_EQ(Positions(Eigen::Matrix3Xd()).cols(), 0);
}

// What is looked at is not copied.
TEST(World, LooksAtMatricesWhereTheyAre) {
  Eigen::Matrix3Xd matrix = icosphere(1).positions;
  Eigen::MatrixXd tall(5, 7);
  EXPECT_EQ(Positions(matrix).data(), matrix.data());
  const Eigen::Ref<const Eigen::Matrix3Xd> ref = matrix;
  EXPECT_EQ(Positions(ref).data(), matrix.data());
  EXPECT_EQ(Positions(Eigen::Map<Eigen::Matrix3Xd>(matrix.data(), 3, 4)).data(), matrix.data());
  EXPECT_EQ(Positions(tall.middleRows(1, 3)).data(), tall.data() + 1);
  EXPECT_EQ(Positions(tall.middleRows(1, 3)).stride(), 5);
  const double* const data = matrix.data();
  EXPECT_EQ(Positions(std::move(matrix)).data(), data);  // taken over
}

}  // namespace
}  // namespace tact::tests

#include <gtest/gtest.h>
#include <tact/tact.h>
#include <tact/tact_c.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace tact::tests {
namespace {

ErrorCode code_of_weld(const Positions& positions, const Facets& facets) {
  try {
    weld(positions, facets);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::backend_failure;
}

TEST(Weld, TheFirstVertexOfEachPlaceStays) {
  Eigen::Matrix3Xd positions(3, 6);
  positions << -0.0, 1, 0, 0, 1, 1e-310,  //
      0, 0, 1, -0.0, 0, 0,                //
      0, 0, 0, 0, -0.0, 0;
  Eigen::Matrix3Xi facets(3, 3);
  facets << 0, 3, 5, 1, 2, 5, 2, 0, 0;
  const WeldedMesh mesh = weld(positions, facets);
  EXPECT_EQ(mesh.vertex_of, (std::vector<int>{0, 1, 2, 0, 1, 3}));
  EXPECT_EQ(mesh.merged_vertices, 2);
  EXPECT_EQ(mesh.collapsed_facets, 1) << "the second: the third had a vertex twice before";
  EXPECT_EQ(mesh.facets, (Eigen::Matrix3Xi(3, 3) << 0, 0, 3, 1, 2, 3, 2, 0, 0).finished());
  ASSERT_EQ(mesh.positions.cols(), 4);
  EXPECT_TRUE(std::signbit(mesh.positions(0, 0)));
  EXPECT_EQ(mesh.positions.col(3), positions.col(5));
}

TEST(Weld, AgreesWithComparingAllVertices) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const int vertices = static_cast<int>(random() % 60);
    Eigen::Matrix3Xd positions(3, vertices);
    for (double& x : positions.reshaped()) x = static_cast<double>(random() % 3) * 0.1 - 0.1;
    const WeldedMesh mesh = weld(positions, Eigen::Matrix3Xi(3, 0));
    for (int v = 0; v < vertices; ++v) {
      EXPECT_EQ(mesh.positions.col(mesh.vertex_of[static_cast<std::size_t>(v)]), positions.col(v)) << "case " << i;
      for (int w = 0; w < v; ++w) {
        EXPECT_EQ(mesh.vertex_of[static_cast<std::size_t>(v)] == mesh.vertex_of[static_cast<std::size_t>(w)],
                  positions.col(v) == positions.col(w))
            << "case " << i;
      }
    }
    EXPECT_EQ(mesh.positions.cols() + mesh.merged_vertices, vertices);
  }
}

// A cube of a vertex per corner meets itself along all its edges.
TEST(Weld, ACubeOfAVertexPerCornerIsClean) {
  Eigen::Matrix3Xd positions(3, 36);
  Eigen::Matrix3Xi facets(3, 12);
  int corner = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const std::array<std::array<int, 2>, 6> square{{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}};
      for (int k = 0; k < 6; ++k) {
        const auto& [u, v] = square[static_cast<std::size_t>(side == 1 ? k : 5 - k)];
        positions((axis + 1) % 3, corner) = u;
        positions((axis + 2) % 3, corner) = v;
        positions(axis, corner++) = side;
      }
    }
  }
  for (int i = 0; i < 36; ++i) facets(i % 3, i / 3) = i;
  const WeldedMesh mesh = weld(positions, facets);
  EXPECT_EQ(mesh.positions.cols(), 8);
  EXPECT_EQ(mesh.collapsed_facets, 0);
  World world;
  world.add_body({.positions = mesh.positions, .facets = mesh.facets, .self_contact = true});
  EXPECT_TRUE(world.detect().contacts().empty());
  World soup;
  soup.add_body({.positions = positions, .facets = facets, .self_contact = true});
  EXPECT_FALSE(soup.detect().contacts().empty());
}

TEST(Weld, RefusesWhatABodyRefuses) {
  Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 3);
  Eigen::Matrix3Xi facets(3, 1);
  facets << 0, 1, 3;
  EXPECT_EQ(code_of_weld(positions, facets), ErrorCode::facet_out_of_range);
  facets << 0, 1, 2;
  positions(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of_weld(positions, facets), ErrorCode::non_finite_position);
  positions(1, 2) = 1e200;
  EXPECT_EQ(code_of_weld(positions, facets), ErrorCode::position_out_of_range);
  EXPECT_EQ(code_of_weld(Eigen::MatrixXd::Zero(2, 3), facets), ErrorCode::wrong_size);
}

TEST(Weld, InC) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, -0.0f};
  const uint16_t facets[] = {0, 1, 2, 2, 3, 1};
  const tact_columns vertices{positions, 4, 12, TACT_FLOAT32}, corners{facets, 2, 6, TACT_UINT16};
  std::array<double, 12> coordinates{};
  std::array<int, 6> welded_corners{};
  std::array<int, 4> vertex_of{};
  tact_welded_mesh mesh = TACT_WELDED_MESH_INIT;
  ASSERT_EQ(tact_weld(&vertices, &corners, &mesh), TACT_OK) << "only counts";
  EXPECT_EQ(mesh.vertices, 3);
  EXPECT_EQ(mesh.merged_vertices, 1);
  EXPECT_EQ(mesh.collapsed_facets, 1);
  mesh.positions = coordinates.data();
  mesh.facets = welded_corners.data();
  mesh.vertex_of = vertex_of.data();
  ASSERT_EQ(tact_weld(&vertices, &corners, &mesh), TACT_OK);
  EXPECT_EQ(coordinates, (std::array<double, 12>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(welded_corners, (std::array<int, 6>{0, 1, 2, 2, 1, 1}));
  EXPECT_EQ(vertex_of, (std::array<int, 4>{0, 1, 2, 1}));
  EXPECT_EQ(tact_weld(nullptr, &corners, &mesh), TACT_ERROR_NULL_ARGUMENT);
  mesh.struct_size = 1;
  EXPECT_EQ(tact_weld(&vertices, &corners, &mesh), TACT_ERROR_WRONG_STRUCT_SIZE);
}

}  // namespace
}  // namespace tact::tests

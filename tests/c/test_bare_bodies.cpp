// Edges, points and planes through the interface for C.
#include <gtest/gtest.h>
#include <tact/tact_c.h>

#include <cstddef>
#include <cstdint>

namespace tact::tests {
namespace {

TEST(BareBodiesOfC, AreAddedAndTold) {
  tact_settings settings = TACT_SETTINGS_INIT;
  settings.points = true;
  tact_world world{};
  ASSERT_EQ(tact_world_create(&settings, &world), TACT_OK);
  const double positions[9] = {0.0, 0.0, 0.1, 1.0, 0.0, 0.3, 2.0, 0.0, 0.2};
  const int32_t edges[2] = {0, 1}, points[1] = {2};
  tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
  definition.positions = {positions, 3, 24, TACT_FLOAT64};
  definition.edges = {edges, 1, 8, TACT_INT32};
  definition.points = points;
  definition.point_count = 1;
  tact_body rope{}, floor{};
  ASSERT_EQ(tact_world_add_body(world, &definition, &rope), TACT_OK);
  tact_plane_definition plane = TACT_PLANE_DEFINITION_INIT;
  plane.offset = -0.5;
  plane.margin = 0.75;
  ASSERT_EQ(tact_world_add_plane(world, &plane, &floor), TACT_OK);
  size_t edge_count = 0, point_count = 0, contacts = 0, count = 0;
  int ends[2]{}, vertex = -1;
  bool is_plane = true;
  tact_plane found{};
  EXPECT_EQ(tact_world_edge_count(world, rope, &edge_count), TACT_OK);
  EXPECT_EQ(tact_world_point_count(world, rope, &point_count), TACT_OK);
  EXPECT_EQ(tact_world_copy_edges(world, rope, ends, 2), TACT_OK);
  EXPECT_EQ(tact_world_copy_points(world, rope, &vertex, 1), TACT_OK);
  EXPECT_EQ(tact_world_plane(world, rope, &is_plane, &found), TACT_OK);
  EXPECT_TRUE(edge_count == 1 && point_count == 1 && ends[1] == 1 && vertex == 2 && !is_plane);
  EXPECT_EQ(tact_world_plane(world, floor, &is_plane, &found), TACT_OK);
  EXPECT_TRUE(is_plane && found.offset == -0.5 && found.normal[2] == 1.0);
  ASSERT_EQ(tact_world_detect(world), TACT_OK);
  ASSERT_EQ(tact_report_contacts(world, &contacts), TACT_OK);
  ASSERT_EQ(contacts, 1u);
  const tact_contact_point* at = nullptr;
  ASSERT_EQ(tact_contact_points(world, 0, &at, &count), TACT_OK);
  ASSERT_EQ(count, 2u);
  EXPECT_EQ(at[0].kind, TACT_VERTEX_PLANE);
  EXPECT_DOUBLE_EQ(at[0].gap, 0.6);
  definition.points = nullptr;
  EXPECT_EQ(tact_world_add_body(world, &definition, &rope), TACT_ERROR_NULL_ARGUMENT);
  plane.normal[0] = 1.0;
  EXPECT_EQ(tact_world_add_plane(world, &plane, &floor), TACT_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tact_world_destroy(world), TACT_OK);
}

}  // namespace
}  // namespace tact::tests

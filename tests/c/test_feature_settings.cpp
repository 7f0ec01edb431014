// Rest offsets, labels, layers of vertices, and meshes of edges that change, through the interface for C.
#include <gtest/gtest.h>
#include <tact/tact_c.h>

#include <cstddef>
#include <cstdint>

namespace tact::tests {
namespace {

// A square above a plane.
class FeatureSettingsOfC : public ::testing::Test {
 protected:
  FeatureSettingsOfC() {
    tact_settings settings = TACT_SETTINGS_INIT;
    settings.points = true;
    EXPECT_EQ(tact_world_create(&settings, &world_), TACT_OK);
    tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
    definition.positions = {kPositions, 4, 24, TACT_FLOAT64};
    definition.facets = {kFacets, 2, 12, TACT_INT32};
    definition.surface = TACT_SURFACE_SHEET;
    definition.margin = 0.1;
    definition.has_rest_offset = true;
    definition.rest_offset = 0.01;
    EXPECT_EQ(tact_world_add_body(world_, &definition, &sheet_), TACT_OK);
    tact_plane_definition plane = TACT_PLANE_DEFINITION_INIT;
    plane.margin = 0.05;
    plane.has_rest_offset = true;
    EXPECT_EQ(tact_world_add_plane(world_, &plane, &floor_), TACT_OK);
  }
  ~FeatureSettingsOfC() override { EXPECT_EQ(tact_world_destroy(world_), TACT_OK); }

  tact_contact contact() {
    tact_contact found = TACT_CONTACT_INIT;
    EXPECT_EQ(tact_world_detect(world_), TACT_OK);
    EXPECT_EQ(tact_report_contact(world_, 0, &found), TACT_OK);
    return found;
  }
  std::size_t points() {
    const tact_contact_point* at = nullptr;
    std::size_t count = 0;
    EXPECT_EQ(tact_contact_points(world_, 0, &at, &count), TACT_OK);
    return count;
  }

  static constexpr double kPositions[12] = {0, 0, 0.03, 1, 0, 0.03, 1, 1, 0.03, 0, 1, 0.03};
  static constexpr std::int32_t kFacets[6] = {0, 1, 2, 0, 2, 3};
  tact_world world_{};
  tact_body sheet_{}, floor_{};
};

TEST_F(FeatureSettingsOfC, RestOffsetsDecideWhatTouches) {
  double rest_offset = 0.0;
  EXPECT_EQ(tact_world_rest_offset(world_, sheet_, &rest_offset), TACT_OK);
  EXPECT_EQ(rest_offset, 0.01);
  EXPECT_EQ(tact_world_rest_offset(world_, floor_, &rest_offset), TACT_OK);
  EXPECT_EQ(rest_offset, 0.0);
  EXPECT_FALSE(contact().touching);
  EXPECT_EQ(tact_world_set_rest_offset(world_, sheet_, nullptr), TACT_OK);
  EXPECT_EQ(tact_world_rest_offset(world_, sheet_, &rest_offset), TACT_OK);
  EXPECT_EQ(rest_offset, 0.1);
  EXPECT_TRUE(contact().touching);
  rest_offset = 0.11;
  EXPECT_EQ(tact_world_set_rest_offset(world_, sheet_, &rest_offset), TACT_ERROR_INVALID_ARGUMENT);
}

TEST_F(FeatureSettingsOfC, AreSetAndGiven) {
  const double offsets[4] = {0.0, 0.02, 0.04, 0.0};
  const std::uint32_t vertex_labels[4] = {10, 11, 12, 13}, facet_labels[2] = {20, 21}, masks[4] = {~0u, ~0u, 0, ~0u};
  tact_feature_settings settings = TACT_FEATURE_SETTINGS_INIT;
  settings.rest_offsets = offsets;
  settings.rest_offset_count = 4;
  settings.vertex_labels = vertex_labels;
  settings.vertex_label_count = 4;
  settings.facet_labels = facet_labels;
  settings.facet_label_count = 2;
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, &settings), TACT_OK);
  EXPECT_TRUE(contact().touching);
  EXPECT_EQ(points(), 4u);
  settings.vertex_masks = masks;
  settings.vertex_mask_count = 4;
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, &settings), TACT_OK);
  EXPECT_FALSE(contact().touching);
  EXPECT_EQ(points(), 3u);
  tact_feature_settings found = TACT_FEATURE_SETTINGS_INIT;
  EXPECT_EQ(tact_world_feature_settings(world_, sheet_, &found), TACT_OK);
  ASSERT_TRUE(found.rest_offset_count == 4 && found.facet_label_count == 2 && found.vertex_layer_count == 0);
  EXPECT_TRUE(found.rest_offsets[2] == 0.04 && found.facet_labels[1] == 21 && found.vertex_masks[2] == 0);
  const int edge[3] = {2, 3, -1}, nothing[3] = {4, -1, -1};
  tact_feature_labels labels{};
  EXPECT_EQ(tact_world_labels(world_, sheet_, edge, &labels), TACT_OK);
  EXPECT_TRUE(labels.vertices[0] == 12 && labels.vertices[1] == 13 && labels.vertices[2] == 0 && labels.facet == 21);
  EXPECT_EQ(tact_world_labels(world_, sheet_, nothing, &labels), TACT_ERROR_INVALID_ARGUMENT);
  settings.facet_label_count = 1;
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, &settings), TACT_ERROR_WRONG_SIZE);
  settings.facet_labels = nullptr;
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, &settings), TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, nullptr), TACT_ERROR_NULL_ARGUMENT);
}

TEST_F(FeatureSettingsOfC, GoWithAMeshOfEdges) {
  const std::uint32_t facet_labels[2] = {20, 21};
  tact_feature_settings settings = TACT_FEATURE_SETTINGS_INIT;
  settings.facet_labels = facet_labels;
  settings.facet_label_count = 2;
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, &settings), TACT_OK);
  const std::int32_t edges[2] = {2, 3}, points[1] = {3}, vertex_map[4] = {0, 1, 2, -1}, facet_map[1] = {1};
  tact_mesh_update update = TACT_MESH_UPDATE_INIT;
  update.positions = {kPositions, 4, 24, TACT_FLOAT64};
  update.facets = {kFacets, 1, 12, TACT_INT32};
  update.edges = {edges, 1, 8, TACT_INT32};
  update.points = points;
  update.point_count = 1;
  update.vertex_map = vertex_map;
  update.vertex_map_count = 4;
  update.facet_map = facet_map;
  update.facet_map_count = 1;
  EXPECT_EQ(tact_world_set_facets_by(world_, sheet_, &update), TACT_OK);
  std::size_t count = 0;
  EXPECT_EQ(tact_world_edge_count(world_, sheet_, &count), TACT_OK);
  EXPECT_EQ(count, 1u);
  tact_feature_settings found = TACT_FEATURE_SETTINGS_INIT;
  EXPECT_EQ(tact_world_feature_settings(world_, sheet_, &found), TACT_OK);
  ASSERT_EQ(found.facet_label_count, 1u);
  EXPECT_EQ(found.facet_labels[0], 21u);
  update.facet_map_count = 2;
  EXPECT_EQ(tact_world_set_facets_by(world_, sheet_, &update), TACT_ERROR_WRONG_SIZE);
  EXPECT_EQ(tact_world_set_facets_by(world_, sheet_, nullptr), TACT_ERROR_NULL_ARGUMENT);
}

TEST_F(FeatureSettingsOfC, LeaveOutBelowTheBody) {
  const std::uint32_t layers[2] = {1, 2}, labels[2] = {20, 21};
  const double margins[4] = {0.1, 0.1, 0.1, 0.02};
  tact_plane_definition plane = TACT_PLANE_DEFINITION_INIT;
  plane.mask = 1;
  plane.margin = 0.0;
  tact_body_definition definition = TACT_BODY_DEFINITION_INIT;
  definition.positions = {kPositions, 4, 24, TACT_FLOAT64};
  definition.facets = {kFacets, 2, 12, TACT_INT32};
  definition.surface = TACT_SURFACE_SHEET;
  definition.margin = 0.1;
  EXPECT_EQ(tact_world_remove_body(world_, sheet_), TACT_OK);
  EXPECT_EQ(tact_world_remove_body(world_, floor_), TACT_OK);
  EXPECT_EQ(tact_world_add_body(world_, &definition, &sheet_), TACT_OK);
  EXPECT_EQ(tact_world_add_plane(world_, &plane, &floor_), TACT_OK);
  tact_feature_settings settings = TACT_FEATURE_SETTINGS_INIT;
  settings.facet_layers = layers;
  settings.facet_layer_count = 2;
  settings.facet_labels = labels;
  settings.facet_label_count = 2;
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, &settings), TACT_OK);
  contact();
  EXPECT_EQ(points(), 3u) << "vertex 3 is of the second facet alone";
  settings.facet_layer_count = 0;
  settings.margins = margins;
  settings.margin_count = 4;
  EXPECT_EQ(tact_world_set_feature_settings(world_, sheet_, &settings), TACT_OK);
  contact();
  EXPECT_EQ(points(), 3u);
  tact_feature_settings found = TACT_FEATURE_SETTINGS_INIT;
  EXPECT_EQ(tact_world_feature_settings(world_, sheet_, &found), TACT_OK);
  ASSERT_TRUE(found.margin_count == 4 && found.facet_layer_count == 0 && found.facet_mask_count == 0);
  EXPECT_EQ(found.margins[3], 0.02);
  bool excluded = true;
  tact_label_pair pair = {sheet_, 20, sheet_, 21, TACT_LABEL_FACET};
  EXPECT_EQ(tact_world_excluded_labels(world_, &pair, &excluded), TACT_OK);
  EXPECT_FALSE(excluded);
  EXPECT_EQ(tact_world_set_excluded_labels(world_, &pair, true), TACT_OK);
  pair = {sheet_, 21, sheet_, 20, TACT_LABEL_FACET};
  EXPECT_EQ(tact_world_excluded_labels(world_, &pair, &excluded), TACT_OK);
  EXPECT_TRUE(excluded);
  pair.kind = 2;
  EXPECT_EQ(tact_world_set_excluded_labels(world_, &pair, true), TACT_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tact_world_set_excluded_labels(world_, nullptr, true), TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_world_excluded_labels(world_, nullptr, &excluded), TACT_ERROR_NULL_ARGUMENT);
}

TEST_F(FeatureSettingsOfC, NeighboursAreSetAndGiven) {
  tact_self_contact_filter filter = TACT_SELF_CONTACT_FILTER_INIT;
  EXPECT_EQ(tact_world_self_contact_filter(world_, sheet_, &filter), TACT_OK);
  EXPECT_TRUE(filter.rings == 0 && filter.rest_distance == 0.0 && filter.rest_positions.count == 0);
  filter.rings = 2;
  filter.rest_distance = 0.5;
  EXPECT_EQ(tact_world_set_self_contact_filter(world_, sheet_, &filter), TACT_OK);
  EXPECT_EQ(tact_world_self_contact_filter(world_, sheet_, &filter), TACT_OK);
  ASSERT_TRUE(filter.rings == 2 && filter.rest_distance == 0.5 && filter.rest_positions.count == 4);
  EXPECT_EQ(static_cast<const double*>(filter.rest_positions.first)[3], 1.0);
  EXPECT_EQ(tact_world_set_self_contact_filter(world_, sheet_, &filter), TACT_OK) << "what is given can be set";
  filter.rest_positions.count = 3;
  EXPECT_EQ(tact_world_set_self_contact_filter(world_, sheet_, &filter), TACT_ERROR_WRONG_SIZE);
  filter.rings = 17;
  EXPECT_EQ(tact_world_set_self_contact_filter(world_, sheet_, &filter), TACT_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tact_world_set_self_contact_filter(world_, sheet_, nullptr), TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_world_self_contact_filter(world_, sheet_, nullptr), TACT_ERROR_NULL_ARGUMENT);
}

}  // namespace
}  // namespace tact::tests

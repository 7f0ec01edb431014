// Pairs within reach in C are those of C++.
#include <gtest/gtest.h>
#include <tact/report_arrays.h>
#include <tact/tact_c.h>
#include <tact/world.h>

#include <algorithm>
#include <vector>

#include "tests/c/mesh_for_c.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

TEST(WithinReachInC, AreThoseOfCpp) {
  tact_settings settings = TACT_SETTINGS_INIT;
  settings.threads = 1;
  settings.within_reach = true;
  tact_world world{};
  ASSERT_EQ(tact_world_create(&settings, &world), TACT_OK);
  World cpp({.threads = 1, .outputs = {.within_reach = true}});
  for (const double z : {0.0, 0.03}) {
    const Mesh mesh = translated(wrinkled_sheet(8, 1.0, 0.02, 1), {0.0, 0.0, z});
    tact_body_definition definition = definition_of(mesh);
    definition.margin = 0.02;
    tact_body body{};
    ASSERT_EQ(tact_world_add_body(world, &definition, &body), TACT_OK);
    cpp.add_body({.positions = mesh.positions, .facets = mesh.facets, .margin = 0.02});
  }
  const Report& report = cpp.detect();
  ASSERT_EQ(tact_world_detect(world), TACT_OK);
  tact_settings read = TACT_SETTINGS_INIT;
  ASSERT_EQ(tact_world_settings(world, &read), TACT_OK);
  EXPECT_TRUE(read.within_reach);
  const tact_reach_pair* pairs = nullptr;
  size_t count = 0, rows = 0;
  ASSERT_EQ(tact_contact_within_reach(world, 0, &pairs, &count), TACT_OK);
  const auto expected = report.contacts()[0].within_reach();
  ASSERT_EQ(count, expected.size());
  ASSERT_GT(count, 100u);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_EQ(pairs[i].kind, static_cast<int>(expected[i].kind));
    EXPECT_EQ(pairs[i].distance, expected[i].distance);
    EXPECT_TRUE(std::ranges::equal(pairs[i].b_vertices, expected[i].b_vertices));
    EXPECT_TRUE(std::ranges::equal(pairs[i].a_weights, expected[i].a_weights));
  }
  ASSERT_EQ(tact_report_reach_pair_count(world, &rows), TACT_OK);
  ASSERT_EQ(rows, count);
  std::vector<int> vertices(3 * rows);
  std::vector<double> normals(3 * rows);
  tact_reach_pair_arrays arrays = TACT_REACH_PAIR_ARRAYS_INIT;
  arrays.a_vertices = vertices.data();
  arrays.normals = normals.data();
  ASSERT_EQ(tact_report_copy_reach_pairs(world, &arrays, rows), TACT_OK);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_TRUE(std::equal(expected[i].a_vertices.begin(), expected[i].a_vertices.end(), vertices.begin() + 3 * i));
    EXPECT_TRUE(std::equal(expected[i].normal.begin(), expected[i].normal.end(), normals.begin() + 3 * i));
  }
  EXPECT_EQ(tact_report_copy_reach_pairs(world, &arrays, rows + 1), TACT_ERROR_WRONG_SIZE);
  tact_world_destroy(world);
}

}  // namespace
}  // namespace tact::tests

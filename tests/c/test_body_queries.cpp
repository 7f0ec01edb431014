// Queries of bodies and kept reports, as C has them, beside those of C++.
#include <gtest/gtest.h>
#include <tact/tact.h>
#include <tact/tact_c.h>

#include <cmath>
#include <vector>

#include "tests/c/mesh_for_c.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

struct TwoBoxes {
  TwoBoxes() {
    EXPECT_EQ(tact_world_create(nullptr, &world), TACT_OK);
    const Mesh left = box({0, 0, 0}, {1, 1, 1}), right = box({3, 0, 0}, {4, 1, 1});
    for (const Mesh* mesh : {&left, &right}) {
      const tact_body_definition definition = definition_of(*mesh);
      EXPECT_EQ(tact_world_add_body(world, &definition, &bodies[mesh == &left ? 0 : 1]), TACT_OK);
    }
  }
  ~TwoBoxes() { tact_world_destroy(world); }
  TwoBoxes(const TwoBoxes&) = delete;
  TwoBoxes& operator=(const TwoBoxes&) = delete;
  tact_world world{};
  tact_body bodies[2]{};
};

TEST(BodyQueriesInC, AnswerAsInCpp) {
  const TwoBoxes c;
  tact_distance_query pair = TACT_DISTANCE_QUERY_INIT;
  pair.a = c.bodies[0], pair.b = c.bodies[1];
  tact_body_distance apart[2]{};
  ASSERT_EQ(tact_world_distance(c.world, &pair, &apart[0]), TACT_OK);
  EXPECT_EQ(apart[0].distance, 2.0);
  EXPECT_EQ(apart[0].b.index, c.bodies[1].index);
  ASSERT_EQ(tact_world_distances(c.world, &pair, 1, &apart[1]), TACT_OK);
  EXPECT_EQ(apart[1].a_facet, apart[0].a_facet);
  tact_nearest_bodies_query near = TACT_NEAREST_BODIES_QUERY_INIT;
  near.body = c.bodies[1];
  size_t count = 0;
  ASSERT_EQ(tact_world_nearest_bodies(c.world, &near, apart, 2, &count), TACT_OK);
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(apart[0].distance, 2.0);
  tact_point_query inside = TACT_POINT_QUERY_INIT;
  inside.point[0] = 0.5, inside.point[1] = 0.5, inside.point[2] = 0.25;
  tact_closest_point closest{};
  ASSERT_EQ(tact_world_signed_distance(c.world, &inside, &closest), TACT_OK);
  EXPECT_EQ(closest.distance, -0.25);
  tact_sweep way = TACT_SWEEP_INIT;
  way.body = c.bodies[0], way.way[0] = 4.0;
  tact_sweep_hit hits[2]{};
  ASSERT_EQ(tact_world_sweep(c.world, &way, &hits[0]), TACT_OK);
  EXPECT_LE(hits[0].fraction, 0.5);
  EXPECT_NEAR(hits[0].fraction, 0.5, 1e-12);
  ASSERT_EQ(tact_world_sweeps(c.world, &way, 1, &hits[1]), TACT_OK);
  EXPECT_EQ(hits[1].fraction, hits[0].fraction);
  tact_overlap both{};
  ASSERT_EQ(tact_world_overlap(c.world, c.bodies[0], c.bodies[1], &both), TACT_OK);
  EXPECT_EQ(both.volume, 0.0);
  EXPECT_EQ(tact_world_overlap(c.world, c.bodies[0], c.bodies[0], &both), TACT_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tact_world_distance(c.world, nullptr, apart), TACT_ERROR_NULL_ARGUMENT);
}

TEST(BodyQueriesInC, AKeptReportStays) {
  const TwoBoxes c;
  tact_world kept{};
  EXPECT_EQ(tact_report_keep(c.world, &kept), TACT_ERROR_WRONG_ORDER);
  const Mesh beside = box({0.5, 0.25, 0.125}, {1.5, 1.25, 1.125}), away = box({9, 0, 0}, {10, 1, 1});
  uint64_t before = 0, after = 0;
  const auto step = [&](const Mesh& mesh) {
    const tact_body_definition definition = definition_of(mesh);
    ASSERT_EQ(tact_world_set_positions(c.world, c.bodies[1], &definition.positions), TACT_OK);
    ASSERT_EQ(tact_world_detect(c.world), TACT_OK);
  };
  step(beside);
  ASSERT_EQ(tact_report_hash(c.world, &before), TACT_OK);
  ASSERT_EQ(tact_report_keep(c.world, &kept), TACT_OK);
  step(away);
  ASSERT_EQ(tact_report_hash(kept, &after), TACT_OK);
  EXPECT_EQ(after, before);
  tact_world same = kept;
  ASSERT_EQ(tact_report_keep(c.world, &kept), TACT_OK);
  EXPECT_EQ(kept.handle, same.handle);
  ASSERT_EQ(tact_report_hash(kept, &after), TACT_OK);
  EXPECT_NE(after, before);
  tact_world other = c.world;
  EXPECT_EQ(tact_report_keep(kept, &other), TACT_ERROR_WRONG_ORDER);
  EXPECT_EQ(tact_report_keep(kept, &kept), TACT_OK);
  EXPECT_EQ(tact_world_destroy(kept), TACT_OK);
}

// Lines from place to place.
TEST(BodyQueriesInC, DistancesAndStencilsAreDrawn) {
  const TwoBoxes c;
  const tact_distance_query query{c.bodies[0], c.bodies[1], HUGE_VAL};
  tact_body_distance apart{};
  ASSERT_EQ(tact_world_distance(c.world, &query, &apart), TACT_OK);
  std::vector<double> lengths;
  const tact_debug_drawer drawer{
      [](void* user, const double* p, const double* q, tact_debug_color) {
        static_cast<std::vector<double>*>(user)->push_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      },
      [](void*, const double*, const double*, const double*, tact_debug_color) {},
      [](void*, const double*, const char*, tact_debug_color) {}, &lengths};
  ASSERT_EQ(tact_world_debug_draw_distances(c.world, &apart, 1, &drawer, nullptr), TACT_OK);
  EXPECT_EQ(lengths, std::vector{apart.distance});
  EXPECT_EQ(tact_world_debug_draw_distances(c.world, nullptr, 1, &drawer, nullptr), TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_world_debug_draw_sums(c.world, nullptr, 0, &drawer, nullptr), TACT_ERROR_WRONG_ORDER);
  const tact_stencil stencil{TACT_STENCIL_POINT_POINT, false, {0, 1, -1, -1}, {-1.0, 1.0}, {1.0, 0.0, 0.0}, 2.0, 0};
  const double corners[6] = {0.0, 0.0, 0.0, 2.0, 0.0, 0.0};
  lengths.clear();
  ASSERT_EQ(tact_stencil_debug_draw(&stencil, 1, corners, 2, &drawer, {}), TACT_OK);
  EXPECT_EQ(lengths, (std::vector{2.0, 1.0}));
  EXPECT_EQ(tact_stencil_debug_draw(&stencil, 1, corners, 1, &drawer, {}), TACT_ERROR_INDEX_OUT_OF_RANGE);
}

}  // namespace
}  // namespace tact::tests

// The interface for C answers as that of C++.
#include <gtest/gtest.h>
#include <tact/tact.h>
#include <tact/tact_c.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "tests/c/world_of_c.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/remeshed.h"

namespace tact::tests {
namespace {

bool equal(const double* c, const Eigen::Vector3d& cpp) { return std::memcmp(c, cpp.data(), 24) == 0; }

void expect_equal(const tact_contact& c, const Contact& cpp) {
  EXPECT_EQ(c.a.index, cpp.a.index);
  EXPECT_EQ(c.b.index, cpp.b.index);
  EXPECT_TRUE(equal(c.direction, cpp.direction));
  EXPECT_EQ(c.depth, cpp.depth);
  EXPECT_EQ(c.source, static_cast<int>(cpp.source));
  EXPECT_EQ(c.iterations, cpp.iterations);
  EXPECT_EQ(c.limit_reached, cpp.limit_reached);
  EXPECT_EQ(c.touching, cpp.touching());
  EXPECT_EQ(c.plane_a, cpp.plane_a);
  EXPECT_EQ(c.plane_b, cpp.plane_b);
  EXPECT_TRUE(equal(c.zone_a.center, cpp.zone_a.center));
  EXPECT_EQ(c.zone_b.radius, cpp.zone_b.radius);
  EXPECT_EQ(c.kept_facets_a, cpp.kept_facets_a);
  EXPECT_EQ(c.kept_facets_b, cpp.kept_facets_b);
  ASSERT_EQ(c.facet_pair_count, cpp.facet_pairs().size());
  for (size_t i = 0; i < c.facet_pair_count; ++i) {
    EXPECT_EQ((FacetPair{c.facet_pairs[i].a, c.facet_pairs[i].b}), cpp.facet_pairs()[i]);
  }
  EXPECT_EQ(c.patch_count, cpp.patches().size());
  EXPECT_EQ(c.containment, static_cast<int>(cpp.containment));
  EXPECT_EQ(c.point_limit_reached, cpp.point_limit_reached);
}

void expect_equal_reports(tact_world c, const Report& cpp) {
  size_t count = 0;
  ASSERT_EQ(tact_report_contacts(c, &count), TACT_OK);
  ASSERT_EQ(count, cpp.contacts().size());
  for (size_t i = 0; i < count; ++i) {
    tact_contact contact = TACT_CONTACT_INIT;
    ASSERT_EQ(tact_report_contact(c, i, &contact), TACT_OK);
    expect_equal(contact, cpp.contacts()[i]);
    size_t found = 0;
    ASSERT_EQ(tact_report_find_contact(c, contact.b, contact.a, &found), TACT_OK);
    EXPECT_EQ(found, i);
    for (size_t k = 0; k < contact.patch_count; ++k) {
      tact_patch patch = TACT_PATCH_INIT;
      ASSERT_EQ(tact_contact_patch(c, i, k, &patch), TACT_OK);
      const Patch& expected = cpp.contacts()[i].patches()[k];
      EXPECT_TRUE(equal(patch.point, expected.point) && equal(patch.direction, expected.direction));
      EXPECT_EQ(patch.depth, expected.depth);
      EXPECT_TRUE(std::ranges::equal(std::span(patch.facet_pairs, patch.facet_pair_count), expected.facet_pairs));
    }
    const tact_contact_point* points = nullptr;
    ASSERT_EQ(tact_contact_points(c, i, &points, &found), TACT_OK);
    ASSERT_EQ(found, cpp.contacts()[i].points().size());
    for (size_t k = 0; k < found; ++k) EXPECT_EQ(points[k].minimum, cpp.contacts()[i].points()[k].minimum);
    ASSERT_EQ(contact.curve_count, cpp.contacts()[i].curves().size());
    for (size_t k = 0; k < contact.curve_count; ++k) {
      tact_curve curve = TACT_CURVE_INIT;
      ASSERT_EQ(tact_contact_curve(c, i, k, &curve), TACT_OK);
      const IntersectionCurve& expected = cpp.contacts()[i].curves()[k];
      EXPECT_EQ(curve.closed, expected.closed);
      ASSERT_EQ(curve.point_count, expected.points.size());
      for (size_t p = 0; p < curve.point_count; ++p) {
        EXPECT_TRUE(equal(curve.points[p].position, expected.points[p].position));
        EXPECT_EQ(curve.points[p].facet_pair, expected.points[p].facet_pair);
        EXPECT_EQ(curve.points[p].edge_of_b, expected.points[p].edge_of_b);
      }
    }
  }
  uint64_t hash = 0;
  ASSERT_EQ(tact_report_hash(c, &hash), TACT_OK);
  EXPECT_EQ(hash, cpp.hash());
}

TEST(C, AnswersAsCpp) {
  std::vector<Mesh> bodies = crowd_of_blobs(20, 3);
  tact_settings settings = TACT_SETTINGS_INIT;
  settings.threads = 2;
  settings.zones = settings.patches = settings.points = settings.curves = true;
  WorldOfC c(&settings);
  tact::World cpp({.threads = 2, .outputs = {.zones = true, .patches = true, .points = true, .curves = true}});
  std::vector<tact_body> c_ids;
  std::vector<BodyId> cpp_ids;
  for (const Mesh& body : bodies) {
    c_ids.push_back(c.add(body));
    cpp_ids.push_back(cpp.add_body({.positions = body.positions, .facets = body.facets}));
  }
  for (int step = 0; step < 3; ++step) {
    ASSERT_EQ(tact_world_detect(c.world), TACT_OK) << tact_last_error_message();
    expect_equal_reports(c.world, cpp.detect());
    std::vector<tact_positions_update> updates;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i] = translated(bodies[i], {0.05, 0.0, 0.03 * static_cast<double>(i % 3)});
      updates.push_back({c_ids[i], columns_of(bodies[i].positions)});
      cpp.set_positions(cpp_ids[i], bodies[i].positions);
    }
    ASSERT_EQ(tact_world_set_positions_of_many(c.world, updates.data(), updates.size()), TACT_OK);
  }
}

// What meets on the way, and what can be asked: as in C++.
TEST(C, TellsMotionAndAnswersQueriesAsCpp) {
  WorldOfC c;
  tact::World cpp;
  const Mesh ball = translated(icosphere(2, 0.2), {0.05, 0.02, 1.0}), wall = sheet(6, 6, 2.0, 2.0);
  const tact_body flying = c.add(ball), standing = c.add(wall);
  const BodyId a = cpp.add_body({.positions = ball.positions, .facets = ball.facets});
  const BodyId b = cpp.add_body({.positions = wall.positions, .facets = wall.facets});
  size_t count = 0;
  EXPECT_EQ(tact_motion_pairs(c.world, &count), TACT_ERROR_WRONG_ORDER);
  ASSERT_EQ(tact_world_detect(c.world), TACT_OK);
  cpp.detect();
  const Mesh behind = translated(ball, {0, 0, -3});
  const tact_columns target = columns_of(behind.positions);
  ASSERT_EQ(tact_world_set_positions(c.world, flying, &target), TACT_OK);
  cpp.set_positions(a, behind.positions);
  ASSERT_EQ(tact_world_detect_motion(c.world, TACT_IMPACTS_ALL), TACT_OK);
  const MotionReport& motion = cpp.detect_motion();
  double first = 0.0;
  ASSERT_EQ(tact_motion_first_time(c.world, &first), TACT_OK);
  EXPECT_EQ(first, motion.first_time());
  const tact_impact* impacts = nullptr;
  ASSERT_EQ(tact_motion_impacts(c.world, &impacts, &count), TACT_OK);
  ASSERT_EQ(count, motion.impacts().size());
  EXPECT_GT(count, 10u);
  for (size_t i = 0; i < count; ++i) {
    const Impact& expected = motion.impacts()[i];
    EXPECT_EQ(impacts[i].kind, static_cast<int>(expected.kind));
    EXPECT_EQ(impacts[i].time, expected.time);
    EXPECT_TRUE(std::equal(impacts[i].a_vertices, impacts[i].a_vertices + 3, expected.a_vertices.begin()));
    EXPECT_TRUE(std::equal(impacts[i].b_vertices, impacts[i].b_vertices + 3, expected.b_vertices.begin()));
  }
  ASSERT_EQ(tact_motion_pairs(c.world, &count), TACT_OK);
  EXPECT_EQ(count, 1u);
  tact_impact_pair pair = TACT_IMPACT_PAIR_INIT;
  ASSERT_EQ(tact_motion_pair(c.world, 0, &pair), TACT_OK);
  EXPECT_EQ(pair.impact_count, motion.impacts().size());
  EXPECT_EQ(tact_motion_pair(c.world, 1, &pair), TACT_ERROR_INDEX_OUT_OF_RANGE);
  tact_motion_statistics statistics = TACT_MOTION_STATISTICS_INIT;
  ASSERT_EQ(tact_motion_stats(c.world, &statistics), TACT_OK);
  EXPECT_EQ(statistics.candidates, motion.stats().candidates);

  tact_ray ray = TACT_RAY_INIT;
  ray.from[2] = 5.0, ray.to[2] = -5.0;
  tact_ray_hit hit;
  ASSERT_EQ(tact_world_cast_ray(c.world, &ray, TACT_RAY_FIRST, &hit), TACT_OK);
  const RayHit expected = cpp.cast_ray({{0, 0, 5}, {0, 0, -5}});
  EXPECT_EQ(hit.facet, expected.facet);
  EXPECT_EQ(hit.fraction, expected.fraction);
  EXPECT_EQ(expected.body, b);
  EXPECT_EQ(hit.body.index, standing.index);
  std::vector<tact_ray_hit> hits(2);
  ASSERT_EQ(tact_world_cast_ray_all(c.world, &ray, hits.data(), hits.size(), &count), TACT_OK);
  EXPECT_EQ(count, cpp.cast_ray_all({{0, 0, 5}, {0, 0, -5}}).size());
  EXPECT_EQ(hits[1].fraction, cpp.cast_ray_all({{0, 0, 5}, {0, 0, -5}})[1].fraction);
  tact_point_query point = TACT_POINT_QUERY_INIT;
  point.point[0] = 0.05, point.point[1] = 0.02, point.point[2] = -2.0;
  tact_closest_point closest;
  ASSERT_EQ(tact_world_closest_point(c.world, &point, &closest), TACT_OK);
  EXPECT_EQ(closest.distance, cpp.closest_point({.point = {0.05, 0.02, -2.0}}).distance);
  tact_body body;
  ASSERT_EQ(tact_world_bodies_containing(c.world, &point, &body, 1, &count), TACT_OK);
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(body.index, flying.index);
  tact_box_query box = TACT_BOX_QUERY_INIT;
  box.upper[0] = box.upper[1] = box.upper[2] = 0.5;
  ASSERT_EQ(tact_world_overlap_box(c.world, &box, nullptr, 0, &count), TACT_OK);
  EXPECT_EQ(count, cpp.overlap_box({.upper = {0.5, 0.5, 0.5}}).size());
  // Many at once: an empty answer among others, and room for a part of them.
  const size_t in_box = count;
  tact_box_query boxes[3] = {box, TACT_BOX_QUERY_INIT, box};
  boxes[1].lower[0] = boxes[1].upper[0] = 1e3;
  std::vector<tact_facet_of_body> facets(in_box + 1);
  size_t ends[3];
  ASSERT_EQ(tact_world_overlap_boxes(c.world, boxes, 3, facets.data(), facets.size(), ends), TACT_OK);
  EXPECT_EQ(ends[0], in_box);
  EXPECT_EQ(ends[1], in_box);
  EXPECT_EQ(ends[2], 2 * in_box);
  EXPECT_EQ(facets[0].facet, facets[in_box].facet);
  const tact_point_query points[2] = {TACT_POINT_QUERY_INIT, point};
  tact_body bodies[4];
  ASSERT_EQ(tact_world_bodies_containing_each(c.world, points, 2, bodies, 4, ends), TACT_OK);
  EXPECT_EQ(ends[1] - ends[0], 1u);
  EXPECT_EQ(bodies[ends[0]].index, flying.index);
  EXPECT_EQ(tact_world_bodies_containing_each(c.world, points, 2, bodies, 4, nullptr), TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_world_cast_ray(c.world, nullptr, TACT_RAY_FIRST, &hit), TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_world_cast_ray(c.world, &ray, 7, &hit), TACT_ERROR_INVALID_ARGUMENT);
}

TEST(C, MovesRigidBodiesAsCpp) {
  const Mesh ball = icosphere(1);
  WorldOfC c;
  World cpp;
  tact_body_definition definition = definition_of(ball);
  definition.motion = TACT_MOTION_RIGID;
  tact_body bodies[2];
  std::vector<PoseUpdate> poses;
  for (tact_body& body : bodies) {
    ASSERT_EQ(tact_world_add_body(c.world, &definition, &body), TACT_OK) << tact_last_error_message();
    poses.push_back({cpp.add_body({.positions = ball.positions, .facets = ball.facets, .motion = Motion::rigid})});
  }
  // A quarter turn: row by row and column by column differ.
  const tact_pose_update updates[2] = {{bodies[0], {0, -1, 0, 1, 0, 0, 0, 0, 1}, {0.1, 0.2, 0.3}},
                                       {bodies[1], {1, 0, 0, 0, 1, 0, 0, 0, 1}, {1.3, 0.5, 0.2}}};
  poses[0].rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  poses[0].translation << 0.1, 0.2, 0.3;
  poses[1].translation << 1.3, 0.5, 0.2;
  ASSERT_EQ(tact_world_set_poses(c.world, updates, 2), TACT_OK) << tact_last_error_message();
  cpp.set_poses(poses);
  ASSERT_EQ(tact_world_detect(c.world), TACT_OK);
  expect_equal_reports(c.world, cpp.detect());
  EXPECT_FALSE(cpp.detect().contacts().empty());
  const double turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1}, away[3] = {9, 0, 0}, broken[9] = {2, 0, 0, 0, 1, 0, 0, 0, 1};
  ASSERT_EQ(tact_world_set_pose(c.world, bodies[1], turn, away), TACT_OK);
  ASSERT_EQ(tact_world_detect(c.world), TACT_OK);
  size_t count = 1;
  ASSERT_EQ(tact_report_contacts(c.world, &count), TACT_OK);
  EXPECT_EQ(count, 0u);
  expect_failure(tact_world_set_pose(c.world, bodies[1], broken, away), TACT_ERROR_NOT_A_ROTATION, "body 1");
  expect_failure(tact_world_set_pose(c.world, bodies[1], nullptr, away), TACT_ERROR_NULL_ARGUMENT, "");
  expect_failure(tact_world_set_pose(c.world, c.add(ball), turn, away), TACT_ERROR_WRONG_MOTION, "body 2");
  const tact_columns columns = columns_of(ball.positions);
  expect_failure(tact_world_set_positions(c.world, bodies[0], &columns), TACT_ERROR_WRONG_MOTION, "body 0");
}

// Two cubes of one group side by side, and a box over the edge between them.
TEST(C, JoinedMinimaAreThoseOfCpp) {
  tact_settings settings = TACT_SETTINGS_INIT;
  settings.points = true;
  WorldOfC c(&settings);
  World cpp({.outputs = {.points = true}});
  const Mesh meshes[3] = {translated(centered_box({0.5, 0.5, 0.5}), {-0.5, 0.0, 0.0}),
                          translated(centered_box({0.5, 0.5, 0.5}), {0.5, 0.0, 0.0}),
                          translated(centered_box({0.2, 0.2, 0.2}), {0.21, 0.0, 0.71})};
  for (const Mesh& mesh : meshes) {
    tact_body_definition definition = definition_of(mesh);
    definition.group = &mesh == &meshes[2] ? 0 : 7;
    definition.margin = 0.02;
    tact_body body{};
    ASSERT_EQ(tact_world_add_body(c.world, &definition, &body), TACT_OK);
    cpp.add_body({.positions = mesh.positions, .facets = mesh.facets, .group = definition.group, .margin = 0.02});
  }
  ASSERT_EQ(tact_world_detect(c.world), TACT_OK);
  const std::vector<std::uint8_t> expected = joined_minima(cpp, cpp.detect());
  std::vector<std::uint8_t> minima(expected.size());
  ASSERT_EQ(tact_report_joined_minima(c.world, nullptr, minima.data(), minima.size()), TACT_OK);
  EXPECT_EQ(minima, expected);
  tact_joined_surfaces joined = TACT_JOINED_SURFACES_INIT;
  ASSERT_EQ(tact_report_joined_minima(c.world, &joined, minima.data(), minima.size()), TACT_OK);
  EXPECT_EQ(minima, expected);
  EXPECT_EQ(tact_report_joined_minima(c.world, &joined, minima.data(), 1), TACT_ERROR_WRONG_SIZE);
  joined.within = -1.0;
  EXPECT_EQ(tact_report_joined_minima(c.world, &joined, minima.data(), minima.size()), TACT_ERROR_INVALID_ARGUMENT);
}

TEST(C, TellsEventsPairsStatisticsAndTraces) {
  tact_settings settings = TACT_SETTINGS_INIT;
  settings.trace = true;
  Three w(&settings);
  ASSERT_EQ(tact_world_detect(w.world), TACT_OK);
  const tact_candidate_pair* pairs = nullptr;
  const tact_contact_event* events = nullptr;
  size_t count = 0;
  ASSERT_EQ(tact_report_candidate_pairs(w.world, &pairs, &count), TACT_OK);
  ASSERT_EQ(count, 1u);
  EXPECT_TRUE(pairs[0].a.index == 0 && pairs[0].b.index == 1 && pairs[0].hulls_overlap);
  ASSERT_EQ(tact_report_began(w.world, &events, &count), TACT_OK);
  ASSERT_EQ(count, 1u);
  EXPECT_EQ(events[0].b.index, 1u);
  std::vector<tact_statistic> statistics(200);
  ASSERT_EQ(tact_report_stats(w.world, statistics.data(), statistics.size(), &count), TACT_OK);
  ASSERT_LT(count, statistics.size());
  EXPECT_STREQ(statistics[0].name, "bodies");
  EXPECT_EQ(statistics[0].count, 3);
  EXPECT_STREQ(statistics[count - 1].name, "total_ms");
  EXPECT_TRUE(statistics[count - 1].is_time && statistics[count - 1].ms > 0.0);
  ASSERT_EQ(tact_report_trace(w.world, &count), TACT_OK);
  ASSERT_GT(count, 0u);
  tact_trace_event event = TACT_TRACE_EVENT_INIT;
  ASSERT_EQ(tact_report_trace_event(w.world, 0, &event), TACT_OK);
  EXPECT_LE(event.begin_ns, event.end_ns);
  ASSERT_EQ(tact_world_remove_body(w.world, w.b), TACT_OK);
  ASSERT_EQ(tact_world_detect(w.world), TACT_OK);
  ASSERT_EQ(tact_report_ended(w.world, &events, &count), TACT_OK);
  EXPECT_EQ(count, 1u);
}

TEST(C, TellsWhatABodyIs) {
  WorldOfC w;
  const Mesh mesh = icosphere(1);
  tact_body_definition definition = definition_of(mesh);
  definition.surface = TACT_SURFACE_SHEET;
  definition.name = "cloth";
  definition.layer = 4;
  definition.external_id = 0xfeedfacecafebeefu;
  tact_body body{}, listed[2]{};
  ASSERT_EQ(tact_world_add_body(w.world, &definition, &body), TACT_OK);
  ASSERT_EQ(tact_world_set_layers(w.world, body, 4, 6), TACT_OK);
  ASSERT_EQ(tact_world_set_motion(w.world, body, TACT_MOTION_FIXED), TACT_OK);
  const char* name = nullptr;
  tact_surface surface{};
  tact_motion motion{};
  uint32_t layer = 0, mask = 0;
  uint64_t external_id = 0;
  size_t vertices = 0, facets = 0, count = 0, bodies = 0;
  bool contains = false;
  EXPECT_EQ(tact_world_name(w.world, body, &name), TACT_OK);
  EXPECT_EQ(tact_world_surface(w.world, body, &surface), TACT_OK);
  EXPECT_EQ(tact_world_motion(w.world, body, &motion), TACT_OK);
  EXPECT_EQ(tact_world_layer(w.world, body, &layer), TACT_OK);
  EXPECT_EQ(tact_world_mask(w.world, body, &mask), TACT_OK);
  EXPECT_EQ(tact_world_external_id(w.world, body, &external_id), TACT_OK);
  EXPECT_EQ(tact_world_vertex_count(w.world, body, &vertices), TACT_OK);
  EXPECT_EQ(tact_world_facet_count(w.world, body, &facets), TACT_OK);
  EXPECT_EQ(tact_world_contains(w.world, body, &contains), TACT_OK);
  EXPECT_EQ(tact_world_body_count(w.world, &count), TACT_OK);
  EXPECT_EQ(tact_world_bodies(w.world, listed, 2, &bodies), TACT_OK);
  EXPECT_STREQ(name, "cloth");
  EXPECT_EQ(surface, TACT_SURFACE_SHEET);
  EXPECT_EQ(motion, TACT_MOTION_FIXED);
  EXPECT_EQ(layer, 4u);
  EXPECT_EQ(mask, 6u);
  EXPECT_EQ(external_id, 0xfeedfacecafebeefu);
  EXPECT_EQ(vertices, static_cast<size_t>(mesh.vertex_count()));
  EXPECT_EQ(facets, static_cast<size_t>(mesh.facet_count()));
  EXPECT_TRUE(contains);
  EXPECT_TRUE(count == 1 && bodies == 1 && listed[0].generation == body.generation);
}

TEST(C, ChangesFacetsAsCpp) {
  Three one;
  tact::World cpp;
  const tact::BodyId a = cpp.add_body({.positions = one.mesh.positions, .facets = one.mesh.facets});
  Random random(7);
  const Remeshed halves = renumbered(cut(unchanged(one.mesh), {1.0, 0.5, 0.2}, 0.1), random, true);
  const tact_body_definition definition = definition_of(halves.mesh);
  const auto set = [&](const std::vector<int>& map) {
    return tact_world_set_facets(one.world, one.a, &definition.positions, &definition.facets, map.data(), map.size());
  };
  ASSERT_EQ(set(halves.vertex_map), TACT_OK);
  cpp.set_facets(a, halves.mesh.positions, halves.mesh.facets, halves.vertex_map);
  std::size_t vertices = 0;
  ASSERT_EQ(tact_world_vertex_count(one.world, one.a, &vertices), TACT_OK);
  EXPECT_EQ(vertices, cpp.vertex_count(a));
  std::vector<int> corners(3 * cpp.facet_count(a)), expected(corners.size());
  ASSERT_EQ(tact_world_copy_facets(one.world, one.a, corners.data(), corners.size()), TACT_OK);
  cpp.copy_facets(a, expected);
  EXPECT_EQ(corners, expected);
  expect_failure(set({1, 2, 3}), TACT_ERROR_WRONG_SIZE, "vertex map");
  expect_failure(set(std::vector<int>(halves.vertex_map.size(), 5000)), TACT_ERROR_INVALID_ARGUMENT, "vertex 5000");
}

TEST(C, SavesAndRestoresWorldsWithKeys) {
  WorldOfC one, two;
  std::vector<tact_body> bodies;
  for (const std::uint64_t key : {9u, 4u}) {
    const Mesh mesh = translated(icosphere(1), {0.1 * static_cast<double>(key), 0.0, 0.0});
    tact_body_definition definition = definition_of(mesh);
    definition.has_key = true;
    definition.key = key;
    tact_body body{};
    ASSERT_EQ(tact_world_add_body(one.world, &definition, &body), TACT_OK);
    bodies.push_back(body);
    if (key == 4)
      expect_failure(tact_world_add_body(one.world, &definition, &body), TACT_ERROR_INVALID_ARGUMENT, "key 4");
    std::uint64_t found = 0;
    EXPECT_EQ(tact_world_key(one.world, bodies.back(), &found), TACT_OK);
    EXPECT_EQ(found, key);
  }
  ASSERT_EQ(tact_world_detect(one.world), TACT_OK);
  std::uint64_t hash = 0, other_hash = 0;
  ASSERT_EQ(tact_contact_hash(one.world, 0, &hash), TACT_OK);
  tact_contact contact = TACT_CONTACT_INIT;
  ASSERT_EQ(tact_report_contact(one.world, 0, &contact), TACT_OK);
  EXPECT_EQ(contact.a.index, bodies[1].index) << "the smaller key is first";

  size_t count = 0;
  ASSERT_EQ(tact_world_save(one.world, nullptr, 0, &count), TACT_OK);
  std::vector<std::byte> bytes(count);
  ASSERT_EQ(tact_world_save(one.world, bytes.data(), bytes.size(), &count), TACT_OK);
  ASSERT_EQ(count, bytes.size());
  ASSERT_EQ(tact_world_restore(two.world, bytes.data(), bytes.size()), TACT_OK) << tact_last_error_message();
  expect_failure(tact_report_contacts(two.world, &count), TACT_ERROR_WRONG_ORDER, "no report");
  ASSERT_EQ(tact_world_detect(two.world), TACT_OK);
  ASSERT_EQ(tact_contact_hash(two.world, 0, &other_hash), TACT_OK);
  EXPECT_EQ(hash, other_hash);
  bytes.back() ^= std::byte{1};
  expect_failure(tact_world_restore(two.world, bytes.data(), bytes.size()), TACT_ERROR_BAD_STATE, "checksum");
  expect_failure(tact_world_restore(two.world, nullptr, 8), TACT_ERROR_NULL_ARGUMENT, "null");
  expect_failure(tact_world_save(two.world, nullptr, 0, nullptr), TACT_ERROR_NULL_ARGUMENT, "null");
}

TEST(C, RunsOnTheThreadsOfAnExecutor) {
  std::atomic<int> calls = 0;
  tact_settings settings = TACT_SETTINGS_INIT, shown = TACT_SETTINGS_INIT;
  settings.threads = 3;
  settings.executor.user = &calls;
  settings.executor.run = [](void* user, int count, tact_task task, void* data) {
    ++*static_cast<std::atomic<int>*>(user);
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back(task, data, i);
    for (std::thread& thread : threads) thread.join();
  };
  WorldOfC w(&settings), plain;
  for (const Mesh& body : crowd_of_blobs(20, 3)) w.add(body), plain.add(body);
  uint64_t hash = 0, expected = 1;
  ASSERT_EQ(tact_world_detect(w.world), TACT_OK);
  ASSERT_EQ(tact_world_detect(plain.world), TACT_OK);
  ASSERT_EQ(tact_report_hash(w.world, &hash), TACT_OK);
  ASSERT_EQ(tact_report_hash(plain.world, &expected), TACT_OK);
  EXPECT_EQ(hash, expected);
  EXPECT_GT(calls, 0);
  ASSERT_EQ(tact_world_settings(w.world, &shown), TACT_OK);
  EXPECT_EQ(shown.executor.user, &calls);
  EXPECT_EQ(shown.threads, 3);
}

TEST(C, KeepsAMessageForEachThread) {
  expect_failure(tact_world_detect({0}), TACT_ERROR_INVALID_HANDLE, "never given out");
  std::string of_other;
  std::thread([&] { of_other = tact_last_error_message(); }).join();
  EXPECT_EQ(of_other, "");
  EXPECT_STREQ(tact_version(), TACT_VERSION);
}

}  // namespace
}  // namespace tact::tests

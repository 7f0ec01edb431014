// Wrong use of the interface for C is an error with a message.
#include <gtest/gtest.h>
#include <tact/tact_c.h>

#include <atomic>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "tests/c/world_of_c.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"

namespace tact::tests {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(WrongUseOfC, HandlesThatWereDestroyedOrNeverGivenOut) {
  tact_world world{};
  ASSERT_EQ(tact_world_create(nullptr, &world), TACT_OK);
  ASSERT_EQ(tact_world_destroy(world), TACT_OK);
  expect_failure(tact_world_destroy(world), TACT_ERROR_INVALID_HANDLE, "destroyed");
  expect_failure(tact_world_detect(world), TACT_ERROR_INVALID_HANDLE, "destroyed");
  expect_failure(tact_world_detect({0}), TACT_ERROR_INVALID_HANDLE, "never given out");
  expect_failure(tact_world_detect({~uint64_t{0}}), TACT_ERROR_INVALID_HANDLE, "never given out");
}

TEST(WrongUseOfC, BodiesThatAreStaleOrForeign) {
  Three one, other;
  const tact_columns positions = columns_of(one.mesh.positions);
  expect_failure(tact_world_set_positions(other.world, one.a, &positions), TACT_ERROR_FOREIGN_BODY, "another world");
  ASSERT_EQ(tact_world_remove_body(one.world, one.a), TACT_OK);
  expect_failure(tact_world_set_positions(one.world, one.a, &positions), TACT_ERROR_STALE_BODY, "removed");
  expect_failure(tact_world_remove_body(one.world, {0, 0, 0}), TACT_ERROR_STALE_BODY, "names no body");
  expect_failure(tact_world_set_motion(one.world, one.b, 77), TACT_ERROR_INVALID_ARGUMENT, "motion");
}

TEST(WrongUseOfC, NullPointers) {
  Three w;
  ASSERT_EQ(tact_world_detect(w.world), TACT_OK);
  size_t count = 0;
  const tact_contact_event* events = nullptr;
  const tact_body_definition definition = definition_of(w.mesh);
  for (const tact_error error : {
           tact_world_create(nullptr, nullptr),
           tact_world_settings(w.world, nullptr),
           tact_world_set_settings(w.world, nullptr),
           tact_world_add_body(w.world, nullptr, &w.a),
           tact_world_add_body(w.world, &definition, nullptr),
           tact_world_set_positions(w.world, w.a, nullptr),
           tact_world_set_positions_of_many(w.world, nullptr, 1),
           tact_world_set_facets(w.world, w.a, nullptr, &definition.facets, nullptr, 0),
           tact_world_set_facets(w.world, w.a, &definition.positions, nullptr, nullptr, 0),
           tact_world_set_facets(w.world, w.a, &definition.positions, &definition.facets, nullptr, 1),
           tact_world_set_poses(w.world, nullptr, 1),
           tact_world_overlap_boxes(w.world, nullptr, 1, nullptr, 0, &count),
           tact_world_contains(w.world, w.a, nullptr),
           tact_world_body_count(w.world, nullptr),
           tact_world_bodies(w.world, nullptr, 1, &count),
           tact_world_bodies(w.world, nullptr, 0, nullptr),
           tact_world_name(w.world, w.a, nullptr),
           tact_world_vertex_count(w.world, w.a, nullptr),
           tact_report_contacts(w.world, nullptr),
           tact_report_contact(w.world, 0, nullptr),
           tact_report_find_contact(w.world, w.a, w.b, nullptr),
           tact_report_candidate_pairs(w.world, nullptr, &count),
           tact_report_began(w.world, &events, nullptr),
           tact_report_stats(w.world, nullptr, 1, &count),
           tact_report_trace(w.world, nullptr),
           tact_report_hash(w.world, nullptr),
       }) {
    expect_failure(error, TACT_ERROR_NULL_ARGUMENT, "null");
  }
  const tact_columns nothing = {nullptr, static_cast<size_t>(w.mesh.vertex_count()), 24, TACT_FLOAT64};
  expect_failure(tact_world_set_positions(w.world, w.a, &nothing), TACT_ERROR_WRONG_SIZE, "is null");
}

// A batch with one bad pose moves none.
TEST(WrongUseOfC, PosesThatAreNone) {
  const Mesh ball = icosphere(1);
  WorldOfC w, other;
  tact_body_definition definition = definition_of(ball);
  definition.motion = TACT_MOTION_RIGID;
  tact_body a{}, b{};
  ASSERT_EQ(tact_world_add_body(w.world, &definition, &a), TACT_OK);
  ASSERT_EQ(tact_world_add_body(w.world, &definition, &b), TACT_OK);
  const tact_pose_update good{a, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {3, 0, 0}};
  std::vector<double> before(3 * static_cast<size_t>(ball.vertex_count())), after(before.size());
  ASSERT_EQ(tact_world_copy_positions(w.world, a, before.data(), before.size()), TACT_OK);
  const auto expect = [&](const tact_pose_update& bad, tact_error error, const std::string& text) {
    const tact_pose_update updates[2] = {good, bad};
    expect_failure(tact_world_set_poses(w.world, updates, 2), error, text);
    expect_failure(tact_world_set_pose(w.world, bad.body, bad.rotation, bad.translation), error, "");
    ASSERT_EQ(tact_world_copy_positions(w.world, a, after.data(), after.size()), TACT_OK);
    EXPECT_EQ(before, after);
  };
  const auto pose = [&](size_t place, double value) {
    tact_pose_update update{b, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
    (place < 9 ? update.rotation[place] : update.translation[place - 9]) = value;
    return update;
  };
  expect(pose(3, 1e-8), TACT_ERROR_NOT_A_ROTATION, "update 1");
  expect(pose(8, -1.0), TACT_ERROR_NOT_A_ROTATION, "mirrors");
  expect(pose(4, kNan), TACT_ERROR_NOT_A_ROTATION, "nan");
  expect(pose(11, kNan), TACT_ERROR_NON_FINITE_POSITION, "translation");
  expect(pose(9, 1e200), TACT_ERROR_POSITION_OUT_OF_RANGE, "translation");
  tact_pose_update foreign = good;
  foreign.body = other.add(ball);
  expect(foreign, TACT_ERROR_FOREIGN_BODY, "another world");
  const tact_pose_update twice[2] = {good, good};
  expect_failure(tact_world_set_poses(w.world, twice, 2), TACT_ERROR_WRONG_ORDER, "");
  EXPECT_EQ(tact_world_set_poses(w.world, nullptr, 0), TACT_OK);
  tact_motion motion{};
  EXPECT_EQ(tact_world_motion(w.world, b, &motion), TACT_OK);
  EXPECT_EQ(motion, TACT_MOTION_RIGID);
  ASSERT_EQ(tact_world_set_motion(w.world, b, TACT_MOTION_FIXED), TACT_OK);
  expect(pose(9, 1.0), TACT_ERROR_FIXED_BODY, "fixed");
  ASSERT_EQ(tact_world_remove_body(w.world, b), TACT_OK);
  expect(pose(9, 1.0), TACT_ERROR_STALE_BODY, "removed");
}

TEST(WrongUseOfC, SizesKindsAndNumbers) {
  Three w;
  tact_columns positions = columns_of(w.mesh.positions);
  const auto expect = [&](tact_error error, const std::string& text) {
    expect_failure(tact_world_set_positions(w.world, w.a, &positions), error, text);
    positions = columns_of(w.mesh.positions);
  };
  --positions.count, expect(TACT_ERROR_WRONG_SIZE, "vertices, but");
  positions.count = SIZE_MAX, expect(TACT_ERROR_WRONG_SIZE, "larger than any memory");
  positions.stride_bytes = SIZE_MAX, expect(TACT_ERROR_WRONG_SIZE, "larger than any memory");
  for (const int kind : {-1, static_cast<int>(TACT_INT32), static_cast<int>(TACT_UINT16), 5, 1 << 30}) {
    positions.kind = kind, expect(TACT_ERROR_WRONG_SIZE, "float32");
  }
  w.mesh.positions(1, 5) = kNan, expect(TACT_ERROR_NON_FINITE_POSITION, "vertex 5 has y");
  w.mesh.positions(1, 5) = 1e200, expect(TACT_ERROR_POSITION_OUT_OF_RANGE, "vertex 5 has y");
  w.mesh.positions(1, 5) = 0.0;
  tact_body_definition definition = definition_of(w.mesh);
  definition.struct_size = 3;
  expect_failure(tact_world_add_body(w.world, &definition, &w.a), TACT_ERROR_WRONG_STRUCT_SIZE, "struct_size");
  definition = definition_of(w.mesh);
  w.mesh.facets(2, 7) = 1000;
  expect_failure(tact_world_add_body(w.world, &definition, &w.a), TACT_ERROR_FACET_OUT_OF_RANGE, "facet 7");
  definition.facets.count = size_t{1} << 40;
  expect_failure(tact_world_add_body(w.world, &definition, &w.a), TACT_ERROR_TOO_LARGE, "536870911");
  tact_settings settings = TACT_SETTINGS_INIT;
  settings.gjk_tolerance = kNan;
  expect_failure(tact_world_set_settings(w.world, &settings), TACT_ERROR_BAD_SETTINGS, "gjk_tolerance");
  settings = TACT_SETTINGS_INIT;
  settings.accuracy = -4;
  expect_failure(tact_world_create(&settings, &w.world), TACT_ERROR_BAD_SETTINGS, "accuracy");
  size_t count = 0;
  EXPECT_EQ(tact_world_body_count(w.world, &count), TACT_OK);
  EXPECT_EQ(count, 3u);
}

TEST(WrongUseOfC, ReportsThatAreNotThereAndIndicesBeyondTheEnd) {
  Three w;
  size_t count = 0;
  tact_contact contact = TACT_CONTACT_INIT;
  tact_patch patch = TACT_PATCH_INIT;
  tact_curve curve = TACT_CURVE_INIT;
  tact_trace_event event = TACT_TRACE_EVENT_INIT;
  expect_failure(tact_report_contacts(w.world, &count), TACT_ERROR_WRONG_ORDER, "no report");
  ASSERT_EQ(tact_world_detect(w.world), TACT_OK);
  expect_failure(tact_report_contact(w.world, 1, &contact), TACT_ERROR_INDEX_OUT_OF_RANGE, "index");
  expect_failure(tact_contact_patch(w.world, 0, 0, &patch), TACT_ERROR_INDEX_OUT_OF_RANGE, "index");
  expect_failure(tact_contact_curve(w.world, 0, 0, &curve), TACT_ERROR_INDEX_OUT_OF_RANGE, "index");
  expect_failure(tact_report_trace_event(w.world, 0, &event), TACT_ERROR_INDEX_OUT_OF_RANGE, "index");
  const tact_settings settings = TACT_SETTINGS_INIT;
  ASSERT_EQ(tact_world_set_settings(w.world, &settings), TACT_OK);
  expect_failure(tact_report_contacts(w.world, &count), TACT_ERROR_WRONG_ORDER, "no report");
}

// The executor runs while the world is in detect(): another thread, or the same, that calls it then is told so.
TEST(WrongUseOfC, CallsFromTwoThreads) {
  struct Shared {
    tact_world world{};
    std::atomic<int> busy = 0;
  } shared;
  tact_settings settings = TACT_SETTINGS_INIT;
  settings.threads = 2;
  settings.executor.user = &shared;
  settings.executor.run = [](void* user, int, tact_task, void*) {
    Shared& s = *static_cast<Shared*>(user);
    const auto call = [&s] {
      size_t count = 0;
      for (const tact_error error :
           {tact_world_detect(s.world), tact_world_destroy(s.world), tact_world_body_count(s.world, &count)}) {
        expect_failure(error, TACT_ERROR_BUSY, "another thread");
        ++s.busy;
      }
    };
    std::thread(call).join();
    call();
  };
  WorldOfC w(&settings);
  shared.world = w.world;
  for (const Mesh& body : crowd_of_blobs(20, 3)) w.add(body);
  EXPECT_EQ(tact_world_detect(w.world), TACT_OK);
  EXPECT_GT(shared.busy, 0);
}

}  // namespace
}  // namespace tact::tests

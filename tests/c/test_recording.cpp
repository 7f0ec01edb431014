// Recordings, meshes read back, messages and drawings through the interface for C.
#include <gtest/gtest.h>
#include <tact/tact.h>
#include <tact/tact_c.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/c/mesh_for_c.h"
#include "tests/support/environment/temporary_folder.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

tact_body add(tact_world world, const Mesh& mesh, const char* name) {
  tact_body_definition definition = definition_of(mesh);
  definition.name = name;
  tact_body body{};
  EXPECT_EQ(tact_world_add_body(world, &definition, &body), TACT_OK) << tact_last_error_message();
  return body;
}

class RecordingInC : public ::testing::Test {
 protected:
  RecordingInC() { EXPECT_EQ(tact_world_create(nullptr, &world_), TACT_OK); }
  ~RecordingInC() override { tact_world_destroy(world_); }

  // Two balls, of which one moves; the hashes of the steps.
  std::vector<uint64_t> play() {
    const Mesh ball = icosphere(1);
    const tact_body a = add(world_, ball, "a");
    add(world_, translated(ball, {1.5, 0.0, 0.0}), "b");
    std::vector<uint64_t> hashes;
    for (int step = 0; step < 3; ++step) {
      const Mesh there = translated(ball, {0.1 * step, 0.0, 0.0});
      const tact_columns columns = columns_of(there.positions);
      EXPECT_EQ(tact_world_set_positions(world_, a, &columns), TACT_OK);
      EXPECT_EQ(tact_world_detect(world_), TACT_OK);
      EXPECT_EQ(tact_report_hash(world_, &hashes.emplace_back()), TACT_OK);
    }
    return hashes;
  }

  TemporaryFolder folder_;
  const std::string path_ = in_utf8(folder_.path() / u8"größe 接触.tactrec");
  tact_world world_{};
};

TEST_F(RecordingInC, PlaysAgain) {
  ASSERT_EQ(tact_world_record(world_, path_.c_str()), TACT_OK) << tact_last_error_message();
  const std::vector<uint64_t> hashes = play();
  ASSERT_EQ(tact_world_record(world_, nullptr), TACT_OK);
  tact_player player{};
  ASSERT_EQ(tact_player_open(path_.c_str(), 1, &player), TACT_OK) << tact_last_error_message();
  const char* version = nullptr;
  EXPECT_EQ(tact_player_recorded_by(player, &version), TACT_OK);
  EXPECT_STREQ(version, tact_version());
  tact_world played_world{};
  ASSERT_EQ(tact_player_world(player, &played_world), TACT_OK);
  tact_played_step step = TACT_PLAYED_STEP_INIT;
  bool played = true, cut = true;
  for (const uint64_t hash : hashes) {
    ASSERT_EQ(tact_player_next(player, &step, &played), TACT_OK);
    EXPECT_TRUE(played && step.answered);
    EXPECT_EQ(step.recorded, hash);
    EXPECT_EQ(step.now, hash);
    size_t contacts = 0;
    EXPECT_EQ(tact_report_contacts(played_world, &contacts), TACT_OK);
    EXPECT_EQ(contacts, 1u);
  }
  ASSERT_EQ(tact_player_next(player, &step, &played), TACT_OK);
  EXPECT_FALSE(played);
  size_t byte = 0;
  EXPECT_EQ(tact_player_cut_at(player, &cut, &byte), TACT_OK);
  EXPECT_FALSE(cut);
  EXPECT_EQ(tact_player_close(player), TACT_OK);
  EXPECT_EQ(tact_player_close(player), TACT_ERROR_INVALID_HANDLE);
  size_t count = 0;
  EXPECT_EQ(tact_world_body_count(played_world, &count), TACT_ERROR_INVALID_HANDLE);
}

TEST_F(RecordingInC, WrongUse) {
  EXPECT_EQ(tact_world_record(world_, in_utf8(folder_.path() / "none" / "r").c_str()), TACT_ERROR_FILE);
  tact_player player{};
  EXPECT_EQ(tact_player_open(path_.c_str(), -1, &player), TACT_ERROR_FILE);
  EXPECT_EQ(tact_player_open(in_utf8(folder_.write("r", "tactrex")).c_str(), -1, &player), TACT_ERROR_BAD_RECORDING);
  EXPECT_NE(std::string(tact_last_error_message()).find("byte 0: not a recording"), std::string::npos);
  EXPECT_EQ(tact_player_open(nullptr, -1, &player), TACT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(tact_player_next(player, nullptr, nullptr), TACT_ERROR_INVALID_HANDLE);
  play();
  const std::string kept = in_utf8(folder_.write("kept", "all of it"));
  EXPECT_EQ(tact_world_record(world_, kept.c_str()), TACT_ERROR_WRONG_ORDER);
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / "kept"), 9u);
}

// A state that a recording restores has no motion report: the last one of the played world is gone then.
TEST_F(RecordingInC, ARestoredStateEndsTheMotionReport) {
  ASSERT_EQ(tact_world_record(world_, path_.c_str()), TACT_OK);
  play();
  size_t count = 0;
  ASSERT_EQ(tact_world_save(world_, nullptr, 0, &count), TACT_OK);
  std::vector<char> bytes(count);
  ASSERT_EQ(tact_world_save(world_, bytes.data(), count, &count), TACT_OK);
  ASSERT_EQ(tact_world_restore(world_, bytes.data(), count), TACT_OK);
  ASSERT_EQ(tact_world_detect(world_), TACT_OK);
  ASSERT_EQ(tact_world_record(world_, nullptr), TACT_OK);
  tact_player player{};
  ASSERT_EQ(tact_player_open(path_.c_str(), 1, &player), TACT_OK);
  tact_world played_world{};
  ASSERT_EQ(tact_player_world(player, &played_world), TACT_OK);
  tact_played_step step = TACT_PLAYED_STEP_INIT;
  bool played = true;
  for (int i = 0; i < 3; ++i) ASSERT_EQ(tact_player_next(player, &step, &played), TACT_OK);
  double time = 0.0;
  ASSERT_EQ(tact_world_detect_motion(played_world, TACT_IMPACTS_ALL), TACT_OK);
  EXPECT_EQ(tact_motion_first_time(played_world, &time), TACT_OK);
  ASSERT_EQ(tact_player_next(player, &step, &played), TACT_OK);
  EXPECT_TRUE(played);
  EXPECT_EQ(tact_motion_first_time(played_world, &time), TACT_ERROR_WRONG_ORDER);
  EXPECT_EQ(tact_player_close(player), TACT_OK);
}

// Reading one throws out of a stream iterator, which was an internal error.
TEST_F(RecordingInC, AFolderIsNoRecording) {
  tact_player player = {0};
  EXPECT_EQ(tact_player_open("/", -1, &player), TACT_ERROR_FILE);
  EXPECT_STREQ(tact_last_error_message(), "the recording is a folder");
}

TEST_F(RecordingInC, MeshesAreReadBack) {
  const Mesh ball = icosphere(1);
  const tact_body body = add(world_, ball, "ball");
  Mesh read{Eigen::Matrix3Xd(3, ball.positions.cols()), Eigen::Matrix3Xi(3, ball.facets.cols())};
  const auto vertices = static_cast<size_t>(read.positions.size()), corners = static_cast<size_t>(read.facets.size());
  ASSERT_EQ(tact_world_copy_positions(world_, body, read.positions.data(), vertices), TACT_OK);
  ASSERT_EQ(tact_world_copy_facets(world_, body, read.facets.data(), corners), TACT_OK);
  EXPECT_EQ(read.positions, ball.positions);
  EXPECT_EQ(read.facets, ball.facets);
  EXPECT_EQ(tact_world_copy_facets(world_, body, read.facets.data(), 1), TACT_ERROR_WRONG_SIZE);
  EXPECT_EQ(tact_world_copy_positions(world_, body, nullptr, vertices), TACT_ERROR_NULL_ARGUMENT);
  tact_bounds bounds{};
  ASSERT_EQ(tact_world_bounds(world_, body, &bounds), TACT_OK);
  EXPECT_EQ(bounds.lower[2], ball.positions.row(2).minCoeff());
}

struct Drawn {
  int lines = 0, triangles = 0, texts = 0;
  float red = 0.0f;
};

TEST_F(RecordingInC, WhatWasFoundIsDrawn) {
  Drawn drawn;
  const tact_debug_drawer drawer = {
      .line = [](void* user, const double*, const double*, tact_debug_color) { ++static_cast<Drawn*>(user)->lines; },
      .triangle =
          [](void* user, const double*, const double*, const double*, tact_debug_color color) {
            ++static_cast<Drawn*>(user)->triangles;
            static_cast<Drawn*>(user)->red = color.red;
          },
      .text = [](void* user, const double*, const char*, tact_debug_color) { ++static_cast<Drawn*>(user)->texts; },
      .user = &drawn};
  EXPECT_EQ(tact_world_debug_draw(world_, &drawer, nullptr), TACT_ERROR_WRONG_ORDER);
  play();
  ASSERT_EQ(tact_world_debug_draw(world_, &drawer, nullptr), TACT_OK) << tact_last_error_message();
  EXPECT_GT(drawn.lines, 24);
  EXPECT_GT(drawn.triangles, 0);
  EXPECT_EQ(drawn.texts, 3);  // two names and a depth
  tact_debug_draw_options options;
  ASSERT_EQ(tact_debug_draw_defaults(&options), TACT_OK);
  EXPECT_EQ(options.struct_size, sizeof options);
  options.meeting.red = 0.25f;
  options.boxes = options.names = options.directions = options.candidate_pairs = false;
  drawn = {};
  ASSERT_EQ(tact_world_debug_draw(world_, &drawer, &options), TACT_OK);
  EXPECT_EQ(drawn.lines, 0);
  EXPECT_EQ(drawn.texts, 0);
  EXPECT_EQ(drawn.red, 0.25f);
  options.struct_size = 1000;
  EXPECT_EQ(tact_world_debug_draw(world_, &drawer, &options), TACT_ERROR_WRONG_STRUCT_SIZE);
  EXPECT_EQ(tact_world_debug_draw(world_, nullptr, nullptr), TACT_ERROR_NULL_ARGUMENT);
}

}  // namespace
}  // namespace tact::tests

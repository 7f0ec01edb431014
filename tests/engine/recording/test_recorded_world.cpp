// The recordings that failing tests leave.
#include <gtest/gtest.h>
#include <tact/recording.h>

#include <array>
#include <filesystem>
#include <string>

#include "tests/support/checks/recorded_world.h"
#include "tests/support/environment/temporary_folder.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

// Every kind of call.
void play_steps(RecordedWorld& world) {
  const Mesh a = icosphere(1), b = translated(blob(1, 0.9, 0.3, 1), {1.2, 0.1, 0.0});
  const auto add = [&](const Mesh& mesh) {
    return world.add_body({.positions = mesh.positions, .facets = mesh.facets});
  };
  const BodyId first = add(a), second = add(b);
  world.detect();
  world.set_positions(first, translated(a, {0.1, 0.0, 0.0}).positions);
  world.detect();
  const Mesh there = translated(a, {0.2, 0.0, 0.0}), back = translated(b, {-0.1, 0.0, 0.0});
  world.set_positions(std::array{PositionsUpdate{first, there.positions}, PositionsUpdate{second, back.positions}});
  world.set_settings({.threads = 1, .direction = DirectionPolicy::smallest});
  world.detect();
  world.remove_body(first);
  add(translated(a, {0.5, 0.5, 0.5}));
  world.detect();
}

int steps_with_the_same_hash(const std::string& recording) {
  RecordingPlayer player(recording);
  int same = 0;
  while (const auto step = player.next()) same += step->same() ? 1 : 0;
  return same;
}

TEST(RecordedWorld, KeepsWhatEnteredIt) {
  RecordedWorld world;
  play_steps(world);
  EXPECT_EQ(steps_with_the_same_hash(world.recording()), 4);
}

TEST(RecordedWorld, KeepsItWhenMoved) {
  RecordedWorld world;
  RecordedWorld other = std::move(world);
  play_steps(other);
  EXPECT_EQ(steps_with_the_same_hash(other.recording()), 4);
}

// What a failing test does by itself; the worlds are gone by then.
TEST(RecordedWorld, IsWrittenAfterItsEnd) {
  for (int life = 0; life < 5; ++life) {
    RecordedWorld world;
    play_steps(world);
  }
  const TemporaryFolder folder;
  const std::vector<std::filesystem::path> paths = write_recordings(folder.path());
  EXPECT_EQ(paths.size(), 3u);
  for (const std::filesystem::path& path : paths) {
    EXPECT_EQ(steps_with_the_same_hash(contents(path)), 4) << path;
    EXPECT_TRUE(path.filename().string().starts_with("RecordedWorld.IsWrittenAfterItsEnd")) << path;
  }
}

}  // namespace
}  // namespace tact::tests

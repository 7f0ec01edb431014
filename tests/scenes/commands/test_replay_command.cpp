#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "scenes/commands/check_command.h"
#include "scenes/commands/replay_command.h"
#include "scenes/commands/run_command.h"
#include "scenes/files/file_error.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

class ReplayCommand : public ::testing::Test {
 protected:
  // What replay prints, with the message of its refusal after it.
  static std::string replayed(const ReplayOptions& options) {
    std::ostringstream out;
    try {
      replay(options, out);
    } catch (const FileError& error) {
      out << error.what();
    }
    return out.str();
  }
  static void expect_all_same(const ReplayOptions& options, const std::string& start) {
    const std::string text = replayed(options);
    EXPECT_TRUE(text.starts_with(start)) << text;
    EXPECT_TRUE(text.ends_with(": all hashes are the same\n")) << text;
  }

  tests::TemporaryFolder folder_;
  const std::filesystem::path recording_ = folder_.path() / "r";
};

TEST_F(ReplayCommand, SceneOnTwoThreadsIsTheSameOnOne) {
  std::ostringstream ignored;
  run({.scene = "pile",
       .frames = 12,
       .size = 8,
       .threads = 2,
       .record = recording_.string(),
       .outputs = {.pictures = false}},
      ignored);
  // A step of the scene may ask the engine more than once.
  const std::string on_two = replayed({.recording = recording_}), count = on_two.substr(0, on_two.find(' '));
  EXPECT_GE(std::stoi(count), 12) << on_two;
  expect_all_same({.recording = recording_}, count + " steps on 2 threads in ");
  expect_all_same({.recording = recording_, .threads = 1}, count + " steps on 1 thread in ");
}

TEST_F(ReplayCommand, CheckedFilesPlayAgain) {
  const auto a = folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto b = folder_.write("b/0.off", "OFF\n3 1 0\n0.2 0.2 1\n0.2 0.2 3\n0.3 0.2 1\n3 0 1 2\n");
  folder_.write("b/1.off", "OFF\n3 1 0\n0.2 0.2 -1\n0.2 0.2 1\n0.3 0.2 1\n3 0 1 2\n");
  std::ostringstream ignored;
  check({.meshes = {a, b.parent_path()}, .threads = 1, .record = recording_.string()}, ignored);
  expect_all_same({.recording = recording_}, "2 steps on 1 thread in ");
}

TEST_F(ReplayCommand, FirstDifferenceIsNamed) {
  const auto a = folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::ostringstream ignored;
  check({.meshes = {a, a}, .threads = 1, .frames = 3, .record = recording_.string()}, ignored);
  const auto size = std::filesystem::file_size(recording_);
  std::fstream file(recording_, std::ios::in | std::ios::out | std::ios::binary);
  const auto second_hash = static_cast<std::streamoff>(size) - 19 - 8;  // a step: no positions, detect, its hash
  file.seekg(second_hash);
  const int low = file.get();
  file.seekp(second_hash);
  file.put(static_cast<char>(low ^ 1));
  file.close();
  const std::string text = replayed({.recording = recording_});
  EXPECT_TRUE(text.starts_with("step 1: ")) << text;
  EXPECT_NE(text.find("1 of 3 hashes differ"), std::string::npos) << text;
  EXPECT_NE(text.find(": byte " + std::to_string(second_hash) + ": step 1 is the first whose hash differs"),
            std::string::npos)
      << text;
}

// What a program leaves that is killed while it writes, or in a step: all that is whole plays.
TEST_F(ReplayCommand, CutRecordingPlaysUpToItsLastWholeStep) {
  const auto a = folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::ostringstream ignored;
  check({.meshes = {a, a}, .threads = 1, .frames = 3, .record = recording_.string()}, ignored);
  const auto size = std::filesystem::file_size(recording_);
  std::filesystem::resize_file(recording_, size - 3);  // in the hash of the last step
  const std::string in_hash = replayed({.recording = recording_});
  EXPECT_NE(in_hash.find("step 2 had no answer when it was recorded"), std::string::npos) << in_hash;
  EXPECT_NE(in_hash.find("cut off in the record at byte " + std::to_string(size - 9)), std::string::npos) << in_hash;
  EXPECT_NE(in_hash.find("\n2 steps on 1 thread in "), std::string::npos) << in_hash;
  EXPECT_TRUE(in_hash.ends_with(": all hashes are the same\n")) << in_hash;
  std::filesystem::resize_file(recording_, size - 15);  // in the positions before that step
  const std::string in_positions = replayed({.recording = recording_});
  EXPECT_NE(in_positions.find("cut off in the record at byte "), std::string::npos) << in_positions;
  EXPECT_NE(in_positions.find("\n2 steps on 1 thread in "), std::string::npos) << in_positions;
}

TEST_F(ReplayCommand, WhatIsNoRecordingIsRefused) {
  EXPECT_NE(replayed({.recording = folder_.path()}).find("not a file"), std::string::npos);
  EXPECT_NE(replayed({.recording = folder_.path() / "none"}).find("cannot be opened"), std::string::npos);
  EXPECT_NE(replayed({.recording = folder_.write("empty", "")}).find("the file is empty"), std::string::npos);
}

}  // namespace
}  // namespace tact::scenes

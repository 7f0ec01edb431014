#include <gtest/gtest.h>

#include <utility>

#include "scenes/files/body_files.h"
#include "scenes/files/weld_frames.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string triangle_at(double x) { return "v " + std::to_string(x) + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"; }

std::vector<std::string> names_of(const std::vector<BodyFrames>& bodies) {
  std::vector<std::string> names;
  for (const BodyFrames& body : bodies) names.push_back(body.name);
  return names;
}

std::string refusal_of_bodies(const std::vector<std::filesystem::path>& paths) {
  try {
    read_bodies(paths);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BodyFiles, AFileStandsStill) {
  const tests::TemporaryFolder folder;
  const auto bodies = read_bodies({folder.write("a.obj", kTriangle)});
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_FALSE(bodies[0].moves);
  EXPECT_EQ(bodies[0].positions.size(), 1u);
  EXPECT_EQ(frame_count(bodies), 0);
}

TEST(BodyFiles, AFolderMovesInTheOrderOfItsNames) {
  const tests::TemporaryFolder folder;
  folder.write("seq/f_10.obj", triangle_at(3));
  folder.write("seq/f_02.obj", triangle_at(2));
  folder.write("seq/f_01.off", "OFF\n3 1 0\n1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("seq/readme.txt", "not a frame");
  folder.write("seq/._f_01.obj", "not a frame");
  folder.write("seq/sub.obj/f_00.obj", "not a frame");
  const auto bodies = read_bodies({folder.path() / "seq"});
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_TRUE(bodies[0].moves);
  ASSERT_EQ(frame_count(bodies), 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(bodies[0].positions[i](0, 0), static_cast<double>(i + 1));
  EXPECT_EQ(bodies[0].files[0].filename(), "f_01.off");
}

// By bytes, frame_10 came before frame_2.
TEST(BodyFiles, FramesGoByTheirNumbers) {
  const tests::TemporaryFolder folder;
  for (int frame = 1; frame <= 12; ++frame)
    folder.write("seq/frame_" + std::to_string(frame) + ".obj", triangle_at(frame));
  const auto bodies = read_bodies({folder.path() / "seq"});
  ASSERT_EQ(frame_count(bodies), 12);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(bodies[0].positions[i](0, 0), static_cast<double>(i + 1));
}

// The dart turns inside out: by its own shape, the last frame would be split along the other diagonal, and one between
// crosses itself.
TEST(BodyFiles, PolygonsOfAllFramesAreSplitAsInTheFirst) {
  const tests::TemporaryFolder folder;
  for (const int y : {1, 3, 5, -9}) {
    folder.write("seq/" + std::to_string(y + 10) + ".obj",
                 "v 0 4 0\nv 0 0 0\nv 4 0 0\nv " + std::to_string(y) + " 1 0\nf 1 2 3 4\n");
  }
  folder.write("seq/0.obj", "v 0 4 0\nv 0 0 0\nv 4 0 0\nv 1 1 0\nf 1 2 3 4\n");
  const auto bodies = read_bodies({folder.path() / "seq"});
  ASSERT_EQ(frame_count(bodies), 5);
  ASSERT_EQ(bodies[0].facets.cols(), 2);
  for (const auto& facet : bodies[0].facets.colwise())
    EXPECT_TRUE((facet.array() == 3).any() && (facet.array() == 1).any());
}

TEST(BodyFiles, WeldsWhatIsOneInEveryFrame) {
  const tests::TemporaryFolder folder;
  const std::string facets = "f 1 2 3\nf 4 5 6\n";
  // Vertices 0 and 3, and 1 and 5, are at one place; 1 and 5 part in the second frame.
  folder.write("seq/1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 0\nv 0 0 1\nv 1 0 0\n" + facets);
  folder.write("seq/2.obj", "v 2 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 1\nv 1 0 3\n" + facets);
  auto bodies = read_bodies({folder.path() / "seq"});
  weld_frames(bodies[0]);
  EXPECT_EQ(bodies[0].weld.merged_vertices, 1);
  EXPECT_EQ(bodies[0].weld.collapsed_facets, 0);
  EXPECT_EQ(bodies[0].facets, (Eigen::Matrix3Xi(3, 2) << 0, 0, 1, 3, 2, 4).finished());
  ASSERT_EQ(bodies[0].positions[1].cols(), 5);
  EXPECT_EQ(bodies[0].positions[1](0, 0), 2);
  EXPECT_EQ(bodies[0].positions[1](2, 4), 3);
  auto collapsing = read_bodies({folder.write("c.obj", "v 0 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n")});
  weld_frames(collapsing[0]);
  EXPECT_EQ(collapsing[0].weld.collapsed_facets, 1);
}

TEST(BodyFiles, ReadsNoMoreFramesThanAsked) {
  const tests::TemporaryFolder folder;
  folder.write("seq/1.obj", kTriangle);
  folder.write("seq/2.obj", kTriangle);
  folder.write("seq/3.obj", "broken beyond the frames that are asked for");
  EXPECT_EQ(frame_count(read_bodies({folder.path() / "seq"}, 2)), 2);
}

TEST(BodyFiles, TellsHowManyFilesAreRead) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("a.obj", kTriangle);
  for (const char* frame : {"seq/1.obj", "seq/2.obj", "seq/3.obj"}) folder.write(frame, kTriangle);
  std::vector<std::pair<int, int>> told;
  read_bodies({file, folder.path() / "seq"}, 2, [&](int done, int all) { told.emplace_back(done, all); });
  EXPECT_EQ(told, (std::vector<std::pair<int, int>>{{0, 3}, {1, 3}, {2, 3}, {3, 3}}));
}

TEST(BodyFiles, NamesAreOfFilesAndFoldersAndRepeatWithANumber) {
  const tests::TemporaryFolder folder;
  const auto a = folder.write("a.obj", kTriangle);
  const auto other = folder.write("b/a.obj", kTriangle);
  const auto b = folder.path() / "b";
  EXPECT_EQ(names_of(read_bodies({a, other, a, b, b / "", b / ".", b / ".." / "b"})),
            (std::vector<std::string>{"a.obj", "a.obj#2", "a.obj#3", "b", "b#2", "b#3", "b#4"}));
  folder.write("b#2/1.obj", kTriangle);
  EXPECT_EQ(names_of(read_bodies({b, b, folder.path() / "b#2"})), (std::vector<std::string>{"b", "b#2", "b#2#2"}));
  EXPECT_EQ(names_of(read_bodies({b, folder.path() / "b#2", b})), (std::vector<std::string>{"b", "b#2", "b#3"}));
}

TEST(BodyFiles, RefusesFoldersThatAreNoBody) {
  const tests::TemporaryFolder folder;
  const std::string here = folder.path().string();
  folder.write("empty/readme.txt", "x");
  EXPECT_EQ(refusal_of_bodies({here + "/empty"}),
            here + "/empty: the folder holds no mesh file (.obj, .off, .ply, .stl, .vtp, .vtk)");
  folder.write("one/1.obj", kTriangle);
  folder.write("two/1.obj", kTriangle);
  folder.write("two/2.obj", kTriangle);
  EXPECT_EQ(refusal_of_bodies({here + "/one", here + "/one/1.obj", here + "/two"}),
            here + "/two: 2 mesh files, but " + here + "/one holds 1: all folders must hold the same number of frames");
  EXPECT_EQ(refusal_of_bodies({here + "/none"}), here + "/none: no such file or folder");
}

TEST(BodyFiles, RefusesFramesOfOtherTopology) {
  const tests::TemporaryFolder folder;
  const std::string first = folder.write("seq/1.obj", kTriangle).string();
  const std::string second = (folder.path() / "seq/2.obj").string();
  const std::string rest = ", but the first frame, " + first + ", has ";
  folder.write("seq/2.obj", kTriangle + "v 1 1 1\n");
  EXPECT_EQ(refusal_of_bodies({folder.path() / "seq"}), second + ": 4 vertices" + rest + "3");
  folder.write("seq/2.obj", kTriangle + "f 1 2 3\n");
  EXPECT_EQ(refusal_of_bodies({folder.path() / "seq"}), second + ": 2 facets" + rest + "1");
  folder.write("seq/2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n");
  EXPECT_EQ(refusal_of_bodies({folder.path() / "seq"}),
            second + ": facet 0 has other vertices than in the first frame, " + first);
}

}  // namespace
}  // namespace tact::scenes

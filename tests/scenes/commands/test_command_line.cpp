// The program itself: exit status, standard output and standard error.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tact/version.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

struct Outcome {
  int status = -1;
  std::string out;
  std::string error;
};

// The meshes here are single facets: what is said of their borders has a test of its own.
std::string without_borders(const std::string& error) {
  std::string left;
  std::istringstream lines(error);
  for (std::string line; std::getline(lines, line);)
    if (line.find(" was added as closed and is taken as a sheet") == std::string::npos) left += line + "\n";
  return left;
}

class CommandLine : public ::testing::Test {
 protected:
  // Runs the program in the folder of the test; `arguments`, which may say where output goes, and variables of the
  // environment are for the shell.
  Outcome run(const std::string& arguments, const std::string& variables = "") const {
    const std::string line =
        "cd '" + folder_.path().string() + "' && " + variables + " '" TACT_PROGRAM "' >.out 2>.err " + arguments;
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, tests::contents(folder_.path() / ".out"),
            without_borders(tests::contents(folder_.path() / ".err"))};
  }

  void expect_refusal(const std::string& arguments, int status, const std::string& message) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_TRUE(outcome.error.starts_with("tact: ")) << outcome.error;
    EXPECT_NE(outcome.error.find(message), std::string::npos) << outcome.error;
  }

  void SetUp() override {
    folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_.write("b.off", "OFF\n3 1 0\n0.2 0.2 -1\n0.2 0.2 1\n0.3 0.2 1\n3 0 1 2\n");
  }

  tests::TemporaryFolder folder_;
};

TEST_F(CommandLine, ChecksAndReturnsZero) {
  const Outcome outcome = run("check a.obj b.off");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.error, "");
  EXPECT_NE(outcome.out.find("1 facet pair"), std::string::npos) << outcome.out;
}

TEST_F(CommandLine, JsonOnStandardOutputIsAlone) {
  const Outcome outcome =
      run("check a.obj b.off --sheet b.off --sheet a.obj --accuracy exact --threads 1 --frames 2 --json -");
  EXPECT_EQ(outcome.status, 0);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["threads"], 1);
  EXPECT_EQ(json["frames"].size(), 2u);
  EXPECT_EQ(json["frames"][1]["pairs"][0]["facet_pairs"].dump(), "[[0,0]]");
  EXPECT_EQ(json["bodies"][1]["surface"], "sheet");
}

TEST_F(CommandLine, JsonGoesToAFileBesideTheTable) {
  const Outcome outcome = run("check --json out.json a.obj b.off");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("frame 0"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(tests::contents(folder_.path() / "out.json"))["frames"].size(), 1u);
}

TEST_F(CommandLine, BadInputReturnsOne) {
  folder_.write("bad.obj", "v 0 0 0\nv 1 x 0\n");
  folder_.write("bad.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\n");
  folder_.write("odd\nname.stl", "junk");
  folder_.write("none/readme", "x");
  expect_refusal("check none.obj a.obj", 1, "none.obj: no such file or folder");
  expect_refusal("check a.obj bad.obj", 1, "bad.obj:2: vertex 1: expected a number for y, found 'x'");
  expect_refusal("check a.obj bad.obj --json -", 1, "bad.obj:2: ");
  expect_refusal("check bad.ply", 1, "bad.ply:5: the file ends before end_header");
  expect_refusal("check 'odd\nname.stl'", 1, "odd name.stl: byte 4: ");
  expect_refusal("check none", 1, "none: the folder holds no mesh file");
  expect_refusal("check a.obj --json none/there/x.json", 1, "none/there/x.json: cannot be written: ");
  for (const std::string option : {"--trace", "--gltf", "--json", "--contacts", "--states", "--record"}) {
    expect_refusal("run pile --size 1 --frames 1 --out pictures --vtk vtk " + option + " none/there/x", 1,
                   "none/there/x: cannot be written: ");
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "vtk" / "pile_00000.vtp")) << option << ": a step was made";
  }
  expect_refusal("run pile --size 1 --frames 1 --no-pictures --vtk a.obj", 1, "a.obj: cannot create the folder: ");
  expect_refusal("run pile --size 1 --frames 1 --out a.obj --vtk vtk", 1, "a.obj: cannot be written: ");
  const Outcome full = run("check a.obj --json /dev/full");
  EXPECT_EQ(full.status, 1);
  EXPECT_EQ(full.error, "tact: /dev/full: cannot be written to its end\n");
}

TEST_F(CommandLine, WhatStandardOutputDoesNotTakeIsAnError) {
  ASSERT_EQ(run("check a.obj b.off --record r").status, 0);
  for (const char* command :
       {"check a.obj b.off", "check a.obj --json -", "check a.obj --json r.json", "scenes", "replay r", "--help",
        "--version", "check --help", "run pile --size 1 --frames 1 --no-pictures"}) {
    const Outcome outcome = run(command + std::string(" >/dev/full"));
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_EQ(outcome.error, "tact: standard output: cannot be written to its end\n") << command;
  }
}

// Standard error is closed, full, or a pipe that nobody reads: the status is the same, and nothing else takes the line.
TEST_F(CommandLine, WhatStandardErrorDoesNotTakeChangesNoStatus) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  constexpr int kUnread = 9;  // a digit, as the shell knows no longer numbers
  ASSERT_EQ(dup2(ends[1], kUnread), kUnread);
  for (const int end : ends) close(end);
  folder_.write("empty_face.obj", "v 0 0 0\nf\n");
  for (const std::string to : {" 2>/dev/full", " 2>&-", " 2>&- <&-", " 2>&9"}) {
    EXPECT_EQ(run("check nope.obj" + to).status, 1) << to;
    EXPECT_EQ(run("replay nope" + to).status, 1) << to;
    EXPECT_EQ(run("nope" + to).status, 2) << to;
    EXPECT_EQ(run("check a.obj --json" + to).status, 2) << to;
    EXPECT_EQ(run("check a.obj b.off empty_face.obj --json r.json --record r" + to).status, 0) << to;
    EXPECT_TRUE(nlohmann::json::accept(tests::contents(folder_.path() / "r.json"))) << to;
  }
  close(kUnread);
}

// A file that is opened later does not take the place of standard output.
TEST_F(CommandLine, ClosedStandardOutputIsAnError) {
  for (const std::string closed : {">&-", ">&- <&-"}) {
    const Outcome outcome = run("check a.obj b.off --json r.json " + closed);
    EXPECT_EQ(outcome.status, 1) << closed;
    EXPECT_EQ(outcome.error, "tact: standard output: cannot be written to its end\n") << closed;
    EXPECT_TRUE(nlohmann::json::accept(tests::contents(folder_.path() / "r.json"))) << closed;
  }
}

TEST_F(CommandLine, WarnsOfClosedBodiesWithABorder) {
  const auto warnings = [&](const std::string& arguments) {
    run(arguments);
    const std::string error = tests::contents(folder_.path() / ".err");
    EXPECT_EQ(without_borders(error), "");
    return std::count(error.begin(), error.end(), '\n');
  };
  EXPECT_EQ(warnings("check a.obj b.off"), 2);
  EXPECT_EQ(warnings("check a.obj b.off --frames 3 --sheet a.obj"), 1);
  EXPECT_EQ(warnings("check a.obj b.off --sheet a.obj --sheet b.off"), 0);
}

TEST_F(CommandLine, WarningsGoToStandardErrorAndTheMeshIsRead) {
  folder_.write("empty_face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf\n");
  const Outcome outcome = run("check empty_face.obj b.off --json -");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.error, "tact: warning: empty_face.obj:5: facet 1: a face without corners is left out\n");
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["bodies"][0]["facets"], 1);
}

// An option is no other option's value, and a page needs no name.
TEST_F(CommandLine, OptionsAreNotTakenForValues) {
  const std::string pile = "run pile --size 1 --frames 1 ";
  for (const std::string option : {"--json", "--contacts", "--states", "--gltf", "--vtk", "--trace", "--record",
                                   "--out", "--size", "--every", "--from", "--largest", "--threads", "--accuracy"})
    expect_refusal("run pile " + option + " --no-pictures", 2,
                   option + ": its value is missing; --no-pictures is taken for an option");
  expect_refusal("check a.obj b.off --sheet --points", 2, "--sheet: its value is missing");
  expect_refusal("check a.obj b.off --self --weld", 2, "--self: its value is missing");
  expect_refusal("check a.obj b.off --margin --nothing", 2, "--margin: its value is missing");
  expect_refusal("check a.obj b.off --exclude a.obj --points", 2, "--exclude: its value is missing");
  expect_refusal("view pile --out --frames 1", 2, "--out: its value is missing");
  expect_refusal("replay r --threads -h", 2, "--threads: its value is missing");
  EXPECT_EQ(run("check a.obj --json=--points").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "--points"));
  for (const std::string& line :
       {pile + "--view --no-pictures", std::string("run --size 1 --frames 1 --no-pictures --view pile")}) {
    std::filesystem::remove(folder_.path() / "tact-pile.html");
    EXPECT_EQ(run(line).status, 0) << line;
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "tact-pile.html")) << line;
  }
  EXPECT_EQ(run(pile + "--view --out o4").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "o4"));
  EXPECT_EQ(run(pile + "--no-pictures --view page.html").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "page.html"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "--no-pictures"));
}

TEST_F(CommandLine, WhatIsNoRecordingIsNamed) {
  folder_.write("folder/readme", "x");
  folder_.write("page.tactrec", "<!doctype html>\n");
  folder_.write("empty.tactrec", "");
  expect_refusal("replay folder", 1, "folder: a folder, not a file");
  expect_refusal("replay page.tactrec", 1, "page.tactrec: not a recording but an HTML page");
  expect_refusal("replay empty.tactrec", 1, "empty.tactrec: the file is empty");
  expect_refusal("replay a.obj", 1, "a.obj: byte 0: not a recording");
}

TEST_F(CommandLine, AnOutputThatFailsAtTheEndOfARunTakesNothingElseWithIt) {
  const std::filesystem::path ffmpeg = folder_.write("bin/ffmpeg", "#!/bin/sh\necho no room for it\nexit 1\n");
  std::filesystem::permissions(ffmpeg, std::filesystem::perms::owner_all);
  const Outcome outcome =
      run("run pile --size 1 --frames 1 --out pictures --json /dev/full --gltf /dev/full --trace t.json --record r",
          "PATH=\"$PWD/bin:$PATH\"");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(
      outcome.error.starts_with("tact: /dev/full: cannot be written to its end; /dev/full: cannot be written "
                                "to its end; "))
      << outcome.error;
  EXPECT_TRUE(outcome.error.ends_with("film.mp4: ffmpeg could not make the film: no room for it\n")) << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  for (const char* part : {"pile\n", "1 steps, ", "trace for ui.perfetto.dev: t.json\n",
                           "1 pictures: pictures, a sheet of them: pictures/sheet.png\n"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " is not in\n" << outcome.out;
  }
  EXPECT_EQ(outcome.out.find("Blender"), std::string::npos) << outcome.out;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "pictures" / "sheet.png"));
  EXPECT_TRUE(nlohmann::json::parse(tests::contents(folder_.path() / "t.json")).contains("traceEvents"));
  EXPECT_EQ(run("replay r").status, 0);
}

TEST_F(CommandLine, ARunThatFailsInItsMiddleLeavesTheLastReport) {
  folder_.write("r.json", "of the last run");
  std::filesystem::create_directories(folder_.path() / "vtk" / "pile_00001.vtp");  // in the second frame's way
  const Outcome outcome = run("run pile --size 1 --frames 9 --every 1 --no-pictures --vtk vtk --json r.json");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.error, "tact: vtk/pile_00001.vtp: cannot write the file\n");
  EXPECT_EQ(tests::contents(folder_.path() / "r.json"), "of the last run");
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

TEST_F(CommandLine, WrongUsageReturnsTwo) {
  expect_refusal("", 2, "no command");
  expect_refusal("bogus", 2, "bogus");
  expect_refusal("check", 2, "MESH");
  expect_refusal("check a.obj --bogus", 2, "--bogus");
  expect_refusal("check a.obj --sheet cloth", 2, "--sheet cloth: no body has this name; the bodies are: a.obj");
  expect_refusal("check a.obj b.off --exclude a.obj", 2, "--exclude");
  expect_refusal("check a.obj b.off --exclude a.obj cloth", 2, "--exclude cloth: no body has this name");
  expect_refusal("check a.obj b.off --accuracy perfect", 2, "--accuracy");
  expect_refusal("check a.obj b.off --threads -1", 2, "--threads");
  expect_refusal("check a.obj b.off --threads many", 2, "--threads");
  expect_refusal("check a.obj b.off --frames 0", 2, "--frames");
  expect_refusal("check a.obj --json", 2, "--json");
  expect_refusal("run pile --trace -", 2, "a trace goes to a file, not to standard output");
  for (const std::string option : {"json", "contacts", "out", "gltf", "vtk", "trace", "record"})
    expect_refusal("run pile --" + option + " ''", 2, "--" + option + ": the name is empty");
}

TEST_F(CommandLine, HelpOfCheckTellsWhatFramesTake) {
  EXPECT_NE(run("check --help").out.find("held in memory: 24 bytes a vertex and frame"), std::string::npos);
}

TEST_F(CommandLine, HelpAndVersionReturnZero) {
  EXPECT_EQ(run("--version").out, "tact " TACT_VERSION "\n");
  for (const char* arguments : {"--help", "check --help"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_NE(outcome.out.find("check"), std::string::npos) << arguments;
    EXPECT_EQ(outcome.error, "") << arguments;
  }
}

}  // namespace
}  // namespace tact::scenes

// Every line of a README, of the manual and of --help that calls tact runs as it stands, among files of the names in
// it. Scenes are small and run for two frames without pictures; at night (TACT_PRINTED_IN_FULL) as they stand.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

namespace fs = std::filesystem;

struct PrintedLine {
  std::string page;
  std::string text;
};

// Lines that begin with tact, in blocks of code of a page, or after blanks in a help.
std::vector<PrintedLine> lines_in(const std::string& page, const std::string& text, bool is_help) {
  std::vector<PrintedLine> lines;
  std::istringstream stream(text);
  bool in_code = is_help;
  for (std::string line; std::getline(stream, line);) {
    if (!is_help && line.starts_with("```")) in_code = !in_code;
    const std::size_t begin = line.find_first_not_of(' ');
    if (in_code && begin != std::string::npos && line.substr(begin).starts_with("tact "))
      lines.push_back({page, line.substr(begin)});
  }
  return lines;
}

std::vector<PrintedLine> lines_of_pages() {
  std::vector<PrintedLine> lines;
  for (auto entry = fs::recursive_directory_iterator(TACT_SOURCE_DIR); entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name == "build" || name == "node_modules" || name.starts_with('.')))
      entry.disable_recursion_pending();
    if (entry->path().extension() != ".md") continue;
    for (PrintedLine& line :
         lines_in(fs::relative(entry->path(), TACT_SOURCE_DIR).string(), tests::contents(entry->path()), false))
      lines.push_back(std::move(line));
  }
  return lines;
}

const std::string kPrintedBall = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string kPrintedStl =
    "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n";
const std::string kPrintedOff = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string kPrintedPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

int status_of(const tests::TemporaryFolder& folder, const std::string& line) {
  const int status =
      std::system(("cd '" + folder.path().string() + "' && PATH=\"$PWD/bin:$PATH\" && export PATH && { " + line +
                   "\n} >.out 2>.err </dev/null")
                      .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Among the programs of the folder there is one called tact, which shortens scenes.
void write_program(const tests::TemporaryFolder& folder) {
  const std::string frames = std::getenv("TACT_PRINTED_IN_FULL") == nullptr ? "2" : "";
  const fs::path program = folder.write("bin/tact", "#!/bin/sh\nframes='" + frames + R"('
case "$1 $2" in *.tactrec) frames= ;; run*|view*) ;; *) frames= ;; esac
if [ "$frames" ]; then
  left=$#
  while [ $left -gt 0 ]; do
    case "$1" in
      --frames) shift; left=$((left - 1)) ;;
      --size) shift; left=$((left - 1)); set -- "$@" --size 8 ;;
      *) set -- "$@" "$1" ;;
    esac
    shift; left=$((left - 1))
  done
  set -- "$@" --frames "$frames"
  [ "$1" = view ] || set -- "$@" --no-pictures
fi
exec ')" TACT_PROGRAM R"(' "$@"
)");
  fs::permissions(program, fs::perms::owner_all);
}

// The files and folders that a line names. A folder holds three frames.
void write_files(const tests::TemporaryFolder& folder, const std::string& line) {
  const std::string command = line.substr(0, line.find(" #"));
  std::istringstream words(command);
  const bool records = command.find("--record") != std::string::npos;
  for (std::string word; words >> word;) {
    if (word.ends_with(".obj")) folder.write(word, kPrintedBall);
    if (word.ends_with(".stl")) folder.write(word, kPrintedStl);
    if (word.ends_with(".off")) folder.write(word, kPrintedOff);
    if (word.ends_with(".ply")) folder.write(word, kPrintedPly);
    if (word.ends_with(".pvd")) {
      folder.write("part.obj", kPrintedBall);
      folder.write(word,
                   "<VTKFile type=\"Collection\"><DataSet timestep=\"0\" file=\"part.obj\"/>"
                   "<DataSet timestep=\"1\" file=\"part.obj\"/></VTKFile>");
    }
    if (word.ends_with('/')) {
      for (const char* frame : {"frame_1.obj", "frame_2.obj", "frame_10.obj"}) folder.write(word + frame, kPrintedBall);
    }
    if (word.ends_with(".tactrec") && !records) {
      folder.write("ball.obj", kPrintedBall);
      ASSERT_EQ(status_of(folder, "tact check ball.obj --record " + word), 0);
    }
  }
}

void expect_to_run(const PrintedLine& line) {
  const tests::TemporaryFolder folder;
  write_program(folder);
  // A form, with words in capitals for what is to be put in, tells at least a command that is there.
  std::smatch form;
  if (std::regex_search(line.text, form, std::regex("^tact ([a-z]+).* [A-Z]{4,}"))) {
    EXPECT_EQ(status_of(folder, "tact " + form[1].str() + " --help"), 0) << line.page << ": " << line.text;
    return;
  }
  write_files(folder, line.text);
  EXPECT_EQ(status_of(folder, line.text), 0) << line.page << ": " << line.text << "\n"
                                             << tests::contents(folder.path() / ".err");
  EXPECT_EQ(tests::contents(folder.path() / ".err"), "") << line.page << ": " << line.text;
}

TEST(PrintedCommands, OfEveryPage) {
  const std::vector<PrintedLine> lines = lines_of_pages();
  EXPECT_GE(lines.size(), 15u);
  for (const PrintedLine& line : lines) expect_to_run(line);
}

TEST(PrintedCommands, OfEveryHelp) {
  const tests::TemporaryFolder folder;
  write_program(folder);
  std::size_t count = 0;
  for (const char* command : {"check", "run", "scenes", "view", "replay"}) {
    ASSERT_EQ(status_of(folder, "tact " + std::string(command) + " --help"), 0) << command;
    const std::vector<PrintedLine> lines = lines_in(command, tests::contents(folder.path() / ".out"), true);
    count += lines.size();
    for (const PrintedLine& line : lines) expect_to_run(line);
  }
  EXPECT_GE(count, 15u);
}

}  // namespace
}  // namespace tact::scenes

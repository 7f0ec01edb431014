// The manual's page on the JSON names every field that the program writes, and its tables name no other.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "scenes/commands/check_command.h"
#include "scenes/commands/json_text.h"
#include "scenes/commands/run_command.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

using Names = std::set<std::string>;

const Names kNamedElsewhere = {"stats", "times_ms", "outcomes"};  // what is in these has its names in headers

void add_keys(const Json& json, Names& keys) {
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) keys.insert(key);
    if (!kNamedElsewhere.contains(key)) add_keys(value, keys);
  }
}

void add_keys_of_lines(const std::filesystem::path& file, Names& keys) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) add_keys(Json::parse(line), keys);
}

// What stands between ` in a text.
Names quoted_names(const std::string& text) {
  static const std::regex quoted("`([a-z_]+)`");
  Names names;
  for (std::sregex_iterator match(text.begin(), text.end(), quoted), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

// A cube with corners at (x, y, z) and so far from there, facets outward.
std::string cube_at(double x, double y, double z, double side) {
  std::ostringstream out;
  for (int corner = 0; corner < 8; ++corner) {
    out << "v " << x + side * (corner & 1) << ' ' << y + side * (corner >> 1 & 1) << ' ' << z + side * (corner >> 2)
        << '\n';
  }
  out << "f 1 4 2\nf 1 3 4\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 8 4\nf 3 7 8\nf 1 7 3\nf 1 5 7\nf 2 4 8\nf 2 8 6\n";
  return out.str();
}

TEST(JsonPage, NamesWhatIsWritten) {
  const tests::TemporaryFolder folder;
  folder.write("fall/0.obj", cube_at(0.1, 0.2, 1.5, 1.0));
  folder.write("fall/1.obj", cube_at(0.1, 0.2, 0.6, 1.0));
  const auto fall =
      folder.write("fall.pvd", R"(<VTKFile type="Collection"><Collection><DataSet timestep="0" file="fall/0.obj"/>)"
                               R"(<DataSet timestep="0.5" file="fall/1.obj"/></Collection></VTKFile>)");
  const auto large = folder.write("large.obj", cube_at(0.0, 0.0, 0.0, 1.0));
  const auto small = folder.write("small.obj", cube_at(0.3, 0.3, 0.3, 0.1));
  const auto sheet =
      folder.write("sheet.obj", "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 -1\nv 5.5 1 1\nv 6 0 1\nf 1 2 3\nf 4 5 6\n");
  CheckOptions options{.meshes = {large, small, fall, sheet},
                       .sheets = {"sheet"},
                       .margins = {"0.01"},
                       .selves = {"sheet"},
                       .impacts = true,
                       .weld = true,
                       .surfaces = true,
                       .json = (folder.path() / "check.json").string()};
  options.outputs = {.points = true, .curves = true, .within_reach = true};
  options.view.file = folder.path() / "page.html";
  std::ostringstream out;
  check(options, out);
  RunOptions scene{.scene = "pile", .frames = 30, .size = 3};
  scene.outputs.pictures = false;
  scene.outputs.contacts = (folder.path() / "contacts.jsonl").string();
  scene.outputs.states = (folder.path() / "states.jsonl").string();
  run(scene, out);

  Names written = {"interrupted"};  // that it is there tells test_check_command.cpp
  add_keys(Json::parse(std::ifstream(folder.path() / "check.json")), written);
  add_keys_of_lines(folder.path() / "contacts.jsonl", written);
  add_keys_of_lines(folder.path() / "states.jsonl", written);
  EXPECT_GT(written.size(), 70u);

  const std::string page = tests::contents(std::filesystem::path(TACT_SOURCE_DIR) / "docs/pages/json.md");
  const Names on_page = quoted_names(page);
  for (const std::string& key : written) EXPECT_TRUE(on_page.contains(key)) << key << " is not on the page";
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ")) continue;
    for (const std::string& name : quoted_names(line.substr(0, line.find('|', 1))))
      EXPECT_TRUE(written.contains(name)) << name << " is on the page and not written";
  }
}

}  // namespace
}  // namespace tact::scenes

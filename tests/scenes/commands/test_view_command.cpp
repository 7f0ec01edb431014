#include <gtest/gtest.h>
#include <tact/recording.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scenes/commands/usage_error.h"
#include "scenes/commands/view_command.h"
#include "scenes/files/file_error.h"
#include "tests/support/environment/temporary_folder.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/mesh.h"

namespace tact::scenes {
namespace {

using tests::contents;

class ViewCommand : public ::testing::Test {
 protected:
  // What view prints, or the message of its refusal.
  static std::string viewed(const ViewCommandOptions& options) {
    std::ostringstream out;
    try {
      view(options, out);
    } catch (const FileError& error) {
      return error.what();
    } catch (const UsageError& error) {
      return std::string("usage: ") + error.what();
    }
    return out.str();
  }
  // Two bodies of which one comes closer for ten steps, recorded.
  std::string record() const {
    const std::string file = (folder_.path() / "r.tactrec").string();
    std::ofstream out(file, std::ios::binary);
    Recorder recorder(out);
    World world({.threads = 1});
    world.set_observer(&recorder);
    const tests::Mesh ball = tests::icosphere(2);
    const BodyId moving = world.add_body({.positions = ball.positions, .facets = ball.facets, .name = "moving"});
    const tests::Mesh other = tests::translated(ball, {2.2, 0.1, 0.0});
    world.add_body({.positions = other.positions, .facets = other.facets, .name = "other"});
    for (int step = 0; step < 10; ++step) {
      world.set_positions(moving, tests::translated(ball, {0.05 * step, 0.0, 0.0}).positions);
      world.detect();
    }
    return file;
  }
  ViewCommandOptions to_page(const std::string& what) const {
    return {.what = {what}, .page = {.file = page_.string()}};
  }
  // The text of the part of the page that has this id.
  std::string section(const std::string& id) const {
    const std::string page = contents(page_), mark = "id=\"" + id + "\">";
    const std::size_t begin = page.find(mark);
    if (begin == std::string::npos) return {};
    return page.substr(begin + mark.size(), page.find("</script>", begin) - begin - mark.size());
  }
  nlohmann::json head() const { return nlohmann::json::parse(section("tact-head")); }

  tests::TemporaryFolder folder_;
  const std::filesystem::path page_ = folder_.path() / "page.html";
};

TEST_F(ViewCommand, IsThePageOfTheTreeWithDataInIt) {
  EXPECT_NE(viewed(to_page(record())).find(": 10 steps, "), std::string::npos);
  const std::string tree = contents(std::filesystem::path(TACT_SOURCE_DIR) / "viewer/page.html"),
                    page = contents(page_);
  const std::size_t mark = tree.find("<!--tact:data-->");
  EXPECT_TRUE(page.starts_with(tree.substr(0, mark)));
  EXPECT_TRUE(page.ends_with(tree.substr(mark + 16)));
}

TEST_F(ViewCommand, TellsEveryStep) {
  ViewCommandOptions options = to_page(record());
  options.json = (folder_.path() / "j").string();
  viewed(options);
  const nlohmann::json page = head(), report = nlohmann::json::parse(contents(options.json));
  ASSERT_EQ(page["frames"]["step"].size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(page["frames"]["hash"][i], report["frames"][i]["hash"]);
    for (const auto& column : page["statistics"]["counts"]) {
      EXPECT_EQ(column["values"][i], report["frames"][i]["stats"][std::string(column["name"])]) << column["name"];
    }
  }
  EXPECT_EQ(page["bodies"].size(), report["bodies"].size());
}

TEST_F(ViewCommand, SameRunGivesTheSamePositionsAndContacts) {
  const std::string recording = record();
  viewed(to_page(recording));
  const std::string chunk = section("tact-chunk-0"), meshes = section("tact-meshes");
  EXPECT_FALSE(chunk.empty());
  ViewCommandOptions again = to_page(recording);
  again.threads = 3;
  viewed(again);
  EXPECT_EQ(section("tact-chunk-0"), chunk);
  EXPECT_EQ(section("tact-meshes"), meshes);
}

TEST_F(ViewCommand, StepsAreLeftOut) {
  ViewCommandOptions options = to_page(record());
  options.page.from = 2, options.page.to = 8, options.page.every = 3;
  viewed(options);
  EXPECT_EQ(head()["frames"]["step"], (std::vector<int>{2, 5, 8}));
  options.page.from = 9;
  EXPECT_EQ(viewed(options), "usage: --to: 8 is before --from 9");
  options.page.from = 20, options.page.to = 30;
  EXPECT_NE(viewed(options).find("the page would show no step, of 10"), std::string::npos);
}

TEST_F(ViewCommand, PageThatIsTooLargeSaysWhatToLeaveOut) {
  ViewCommandOptions options{
      .what = {"pile"}, .page = {.file = page_.string(), .largest = 1}, .frames = 40, .size = 60};
  const std::string message = viewed(options);
  EXPECT_NE(message.find("larger than 1 MB"), std::string::npos) << message;
  for (const char* option : {"--every", "--from", "--to", "--largest"})
    EXPECT_NE(message.find(option), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(page_));
}

// Wherever a recording is cut, one line says so and there is no page; up to the cut it can be shown.
TEST_F(ViewCommand, CutRecordingGivesNoPage) {
  const std::string recording = record(), bytes = contents(recording);
  for (std::size_t size = 9; size < bytes.size(); size += bytes.size() / 12) {
    const auto cut = folder_.write("cut.tactrec", std::string_view(bytes).substr(0, size));
    const std::string message = viewed(to_page(cut.string()));
    EXPECT_NE(message.find("byte "), std::string::npos) << size << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(page_)) << size;
  }
  const auto cut = folder_.write("cut.tactrec", std::string_view(bytes).substr(0, bytes.size() - 3));
  ViewCommandOptions options = to_page(cut.string());
  options.page.to = 7;
  EXPECT_NE(viewed(options).find(": 8 steps"), std::string::npos);
}

// Nothing in a name can end the element that it stands in.
TEST_F(ViewCommand, NamesDoNotLeaveTheirElement) {
  const auto mesh = folder_.write("<!--<script>\n\x01\xff.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  viewed({.what = {mesh.string(), mesh.string()}, .page = {.file = page_.string()}});
  EXPECT_EQ(section("tact-head").find('<'), std::string::npos);
  EXPECT_EQ(head()["bodies"][0]["name"], "<!--<script>\n\x01\xef\xbf\xbd.obj");
}

TEST_F(ViewCommand, RefusesToOverwriteWhatItReads) {
  const std::string recording = record();
  ViewCommandOptions options = to_page(recording);
  options.page.file = recording;
  EXPECT_TRUE(viewed(options).starts_with("usage: --out")) << viewed(options);
}

}  // namespace
}  // namespace tact::scenes

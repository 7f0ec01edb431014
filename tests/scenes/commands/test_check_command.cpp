#include <gtest/gtest.h>
#include <tact/version.h>
#include <tact/world.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "scenes/commands/check_command.h"
#include "scenes/commands/json_text.h"
#include "scenes/commands/report_json.h"
#include "scenes/commands/usage_error.h"
#include "scenes/files/body_files.h"
#include "tests/support/environment/temporary_folder.h"
#include "tests/support/generators/bodies.h"

namespace tact::scenes {
namespace {

// A tetrahedron with its right angle at (x, y, z), facets outward.
std::string tetrahedron_at(double x, double y, double z) {
  std::ostringstream out;
  out.precision(17);
  for (int corner = 0; corner < 4; ++corner) {
    out << "v " << x + (corner == 1 ? 1 : 0) << " " << y + (corner == 2 ? 1 : 0) << " " << z + (corner == 3 ? 1 : 0)
        << "\n";
  }
  out << "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  return out.str();
}

Json check_json(CheckOptions options) {
  options.json = "-";
  std::ostringstream out;
  check(options, out);
  return Json::parse(out.str());
}

std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  return keys;
}

class CheckCommand : public ::testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  // a and b cross, the boxes of a and c overlap and their hulls do not, d is far from all.
  const std::filesystem::path a_ = folder_.write("a.obj", tetrahedron_at(0, 0, 0));
  const std::filesystem::path b_ = folder_.write("b.obj", tetrahedron_at(0.1, 0.15, 0.2));
  const std::filesystem::path c_ = folder_.write("c.obj", tetrahedron_at(0.7, 0.7, 0.7));
  const std::filesystem::path d_ = folder_.write("d.obj", tetrahedron_at(9, 9, 9));
};

// A mesh is not written over, by whatever name it is called, nor one output by another.
TEST_F(CheckCommand, NoFileIsWrittenOver) {
  const auto message = [](const CheckOptions& options) -> std::string {
    std::ostringstream out;
    try {
      check(options, out);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  const auto size_before = std::filesystem::file_size(a_);
  const std::string link = (folder_.path() / "link.obj").string();
  std::filesystem::create_symlink(a_, link);
  EXPECT_EQ(message({.meshes = {a_, b_}, .json = link}), "--json: " + link + " is read, and would be lost");
  EXPECT_EQ(message({.meshes = {b_, a_}, .record = a_.string()}),
            "--record: " + a_.string() + " is read, and would be lost");
  EXPECT_EQ(std::filesystem::file_size(a_), size_before);
  const std::string out = (folder_.path() / "out").string();
  EXPECT_EQ(message({.meshes = {a_, b_}, .json = out, .record = out}), "--json and --record: both would be " + out);
  EXPECT_EQ(message({.meshes = {a_, b_}, .json = "/dev/null", .record = "/dev/null"}), "");
  const std::filesystem::path frames = folder_.path() / "frames";
  std::filesystem::create_directory(frames);
  std::filesystem::copy_file(a_, frames / "1.obj");
  EXPECT_EQ(message({.meshes = {frames, b_}, .vtk = frames.string()}),
            "--vtk: " + frames.string() + " is read, and what is written there would be frames of it");
}

TEST_F(CheckCommand, JsonHasTheDocumentedShape) {
  const Json json = check_json({.meshes = {a_, b_, c_, d_}, .threads = 2});
  EXPECT_EQ(keys_of(json), (std::vector<std::string>{"tact", "accuracy", "threads", "bodies", "frames"}));
  EXPECT_EQ(json["tact"], TACT_VERSION);
  EXPECT_EQ(json["accuracy"], "exact");
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["bodies"].size(), 4u);
  EXPECT_EQ(json["bodies"][1].dump(), R"({"name":"b.obj","vertices":4,"facets":4,"surface":"closed"})");
  ASSERT_EQ(json["frames"].size(), 1u);
  const Json& frame = json["frames"][0];
  EXPECT_EQ(keys_of(frame), (std::vector<std::string>{"frame", "hash", "pairs", "stats", "times_ms"}));
  EXPECT_EQ(frame["hash"].get<std::string>().find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(frame["hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(frame["stats"]["candidate_pairs"], 3);
  EXPECT_TRUE(frame["times_ms"].contains("total"));
}

TEST_F(CheckCommand, PairsAreTheCandidatesAndOverlappingOnesTellMore) {
  const Json pairs = check_json({.meshes = {a_, b_, c_, d_}})["frames"][0]["pairs"];
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(keys_of(pairs[0]), (std::vector<std::string>{"a", "b", "hulls_overlap", "direction", "depth", "source",
                                                         "iterations", "limit_reached", "kept_facets", "facet_pairs"}));
  EXPECT_EQ(pairs[0]["a"], 0);
  EXPECT_EQ(pairs[0]["b"], 1);
  EXPECT_EQ(pairs[0]["hulls_overlap"], true);
  EXPECT_EQ(pairs[1].dump(), R"({"a":0,"b":2,"hulls_overlap":false,"facet_pairs":[]})");
  EXPECT_EQ(pairs[2]["a"], 1);
  EXPECT_EQ(pairs[2]["b"], 2);
}

TEST_F(CheckCommand, CurvesHoldEachFacetPairAndPointsTellOfMinima) {
  CheckOptions options{.meshes = {a_, b_}};
  options.outputs = {.points = true, .curves = true};
  const Json pair = check_json(options)["frames"][0]["pairs"][0];
  ASSERT_EQ(pair["curves"].size(), 1u);
  const Json& curve = pair["curves"][0];
  EXPECT_EQ(curve["closed"], true);
  EXPECT_EQ(curve["points"].size(), curve["facets"].size());
  EXPECT_GE(curve["facets"].size(), 3u);
  for (const Json& facets : curve["facets"])
    EXPECT_NE(std::find(pair["facet_pairs"].begin(), pair["facet_pairs"].end(), facets), pair["facet_pairs"].end());
  for (const Json& point : pair["points"]) EXPECT_TRUE(point["minimum"].is_boolean());
}

TEST_F(CheckCommand, NumbersReadBackToTheSameDoubles) {
  const auto bodies = read_bodies({a_, b_});
  World world;
  for (const BodyFrames& body : bodies) world.add_body({.positions = body.positions[0], .facets = body.facets});
  const Report& report = world.detect();
  ASSERT_EQ(report.contacts().size(), 1u);
  const Contact& contact = report.contacts()[0];
  const Json frame = check_json({.meshes = {a_, b_}})["frames"][0];
  const Json& pair = frame["pairs"][0];
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(pair["direction"][axis].get<double>(), contact.direction[axis]);
  }
  EXPECT_EQ(pair["depth"].get<double>(), contact.depth);
  EXPECT_EQ(frame["hash"], hash_text(report));
  Json facet_pairs = Json::array();
  for (const FacetPair& p : contact.facet_pairs()) facet_pairs.push_back(Json::array({p.a, p.b}));
  EXPECT_EQ(pair["facet_pairs"], facet_pairs);
  EXPECT_FALSE(facet_pairs.empty());
}

// Few of these pairs reach the limit, low as it is.
TEST_F(CheckCommand, PairsTellHowTheDirectionWasFoundAndWhetherALimitWasReached) {
  std::set<std::string> sources, limits;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const tests::Mesh still = tests::random_hull(30, seed), moving = tests::random_hull(30, seed + 100);
    World world({.gjk_tolerance = 0.1, .iteration_limit = 1});
    world.add_body({.positions = still.positions, .facets = still.facets});
    const BodyId b = world.add_body({.positions = moving.positions, .facets = moving.facets});
    for (const double x : {1.5, 0.5, 0.1}) {
      world.set_positions(b, moving.positions.colwise() + x * Eigen::Vector3d(1.0, 0.9, 0.8));
      const Report& report = world.detect();
      if (report.contacts().empty()) continue;
      std::ostringstream out;
      JsonReport json(out, world);
      json.add_frame(0, report);
      json.finish();
      const Json pair = Json::parse(out.str())["frames"][0]["pairs"][0];
      EXPECT_EQ(pair["limit_reached"], report.contacts()[0].limit_reached) << "seed " << seed;
      EXPECT_EQ(pair["source"], direction_source_name(report.contacts()[0].source)) << "seed " << seed;
      sources.insert(pair["source"]);
      limits.insert(pair["limit_reached"].dump());
    }
  }
  EXPECT_TRUE(sources.contains("carried") && sources.size() > 1);
  EXPECT_EQ(limits, (std::set<std::string>{"false", "true"}));
}

TEST_F(CheckCommand, HullsHaveNoFacets) {
  const Json json = check_json({.meshes = {a_, b_, c_}, .accuracy = Accuracy::hulls});
  EXPECT_EQ(json["accuracy"], "hulls");
  ASSERT_EQ(json["frames"][0]["pairs"].size(), 3u);
  for (const Json& pair : json["frames"][0]["pairs"]) EXPECT_TRUE(pair["facet_pairs"].is_null());
}

TEST_F(CheckCommand, SheetsAreNamed) {
  const Json bodies = check_json({.meshes = {a_, a_, b_}, .sheets = {"a.obj#2", "b.obj"}})["bodies"];
  EXPECT_EQ(bodies[0]["surface"], "closed");
  EXPECT_EQ(bodies[1]["name"], "a.obj#2");
  EXPECT_EQ(bodies[1]["surface"], "sheet");
  EXPECT_EQ(bodies[2]["surface"], "sheet");
  EXPECT_THROW(check_json({.meshes = {a_}, .sheets = {"c"}}), UsageError);
}

// The names of files without their endings are understood where only one body has them.
TEST_F(CheckCommand, NamesNeedNoEnding) {
  const auto stl = folder_.write("a.stl", "solid\nendsolid\n");
  const auto folder = folder_.write("moves/1.obj", tetrahedron_at(5, 5, 5)).parent_path();
  const auto dotted = folder_.write("v1.2.obj", tetrahedron_at(0, 0, 0));
  const Json json = check_json({.meshes = {b_, b_, c_, folder, dotted},
                                .sheets = {"b#2", "c"},
                                .margins = {"v1.2=0.5", "moves=0.1"},
                                .selves = {"b"},
                                .excluded = {{"b", "b#2"}}});
  const Json& bodies = json["bodies"];
  EXPECT_EQ(bodies[0]["surface"], "closed");
  EXPECT_EQ(bodies[1]["surface"], "sheet");
  EXPECT_EQ(bodies[2]["surface"], "sheet");
  EXPECT_EQ(json["frames"][0]["stats"]["named_excluded_pairs"], 1);
  const auto message = [](const CheckOptions& options) -> std::string {
    std::ostringstream out;
    try {
      check(options, out);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({.meshes = {a_, stl}, .sheets = {"a"}}),
            "--sheet a: the name without its ending of several bodies: a.obj, a.stl");
  EXPECT_EQ(message({.meshes = {a_, stl}, .sheets = {"a.stl"}}), "");
  EXPECT_EQ(message({.meshes = {dotted}, .sheets = {"v1"}}),
            "--sheet v1: no body has this name; the bodies are: v1.2.obj");
  // A name that is a body's own is that body's, though it is another's without its ending.
  const auto shadow = folder_.write("a/1.obj", tetrahedron_at(0, 0, 0)).parent_path();
  EXPECT_EQ(check_json({.meshes = {a_, shadow}, .sheets = {"a"}})["bodies"][1]["surface"], "sheet");
}

// frame_10 came before frame_2: what meets between 6 and 7 met in three other frames.
TEST_F(CheckCommand, FramesHaveNaturalOrderAndTheJsonNamesTheirFiles) {
  const auto wall = folder_.write("wall.obj", "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n");
  for (int frame = 1; frame <= 12; ++frame) {
    std::ostringstream mesh;
    for (const char* corner : {"0 0 ", "1 0 ", "0 1 "}) mesh << "v " << corner << 6.5 - frame << "\n";
    folder_.write("fall/frame_" + std::to_string(frame) + ".obj", mesh.str() + "f 1 2 3\n");
  }
  const auto fall = folder_.path() / "fall";
  const Json frames = check_json({.meshes = {fall, wall}, .sheets = {"fall", "wall"}, .impacts = true})["frames"];
  ASSERT_EQ(frames.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(frames[i]["files"],
              Json::array({(fall / ("frame_" + std::to_string(i + 1) + ".obj")).string(), wall.string()}));
    EXPECT_EQ(i > 0 && !frames[i]["first_time"].is_null(), i == 6) << i;
  }
  EXPECT_NEAR(frames[6]["first_time"].get<double>(), 0.5, 1e-6);
  EXPECT_FALSE(check_json({.meshes = {a_, b_}})["frames"][0].contains("files"));
}

// A vertex per corner: its facets, which share edges, met as strangers.
TEST_F(CheckCommand, WeldsAndCounts) {
  std::string corners;
  int count = 0;
  for (const char* facet : {"0 0 0,0 1 0,1 0 0", "0 0 0,1 0 0,0 0 1", "0 0 0,-0 0 1,0 1 0", "1 0 0,0 1 0,0 0 1"}) {
    std::istringstream vertices(facet);
    for (std::string vertex; std::getline(vertices, vertex, ',');) corners += "v " + vertex + "\n";
    corners +=
        "f " + std::to_string(count + 1) + " " + std::to_string(count + 2) + " " + std::to_string(count + 3) + "\n";
    count += 3;
  }
  const auto soup = folder_.write("soup.obj", corners);
  const auto self_pairs = [&](bool weld) {
    const Json json = check_json({.meshes = {soup}, .selves = {"soup"}, .weld = weld});
    EXPECT_EQ(json["bodies"][0]["vertices"], weld ? 4 : 12);
    EXPECT_EQ(json["bodies"][0].contains("merged_vertices"), weld);
    if (weld) {
      EXPECT_EQ(json["bodies"][0]["merged_vertices"], 8);
    }
    return json["frames"][0]["stats"]["facet_pairs"].get<int>();
  };
  EXPECT_EQ(self_pairs(false), 6);
  EXPECT_EQ(self_pairs(true), 0);
  std::ostringstream out;
  check({.meshes = {soup}, .weld = true}, out);
  EXPECT_NE(out.str().find("welded soup.obj: 8 of 12 vertices merged with another\n"), std::string::npos) << out.str();
}

TEST_F(CheckCommand, SurfacesAreChecked) {
  const Json whole = check_json({.meshes = {a_, b_}, .surfaces = true})["bodies"][0]["check"];
  EXPECT_TRUE(whole["solid"].get<bool>());
  for (const char* const fault : {"border_edges", "branching_edges", "turned_facets", "crossings", "repeated_facets",
                                  "repeated_vertices", "slivers", "unused_vertices"})
    EXPECT_TRUE(whole[fault].is_array() && whole[fault].empty()) << fault;
  EXPECT_FALSE(check_json({.meshes = {a_, b_}})["bodies"][0].contains("check"));
}

TEST_F(CheckCommand, ExcludedPairsAreLeftOutAndCounted) {
  const Json frame = check_json({.meshes = {a_, b_, c_}, .excluded = {{"b.obj", "a.obj"}}})["frames"][0];
  ASSERT_EQ(frame["pairs"].size(), 2u);
  EXPECT_EQ(frame["pairs"][0]["b"], 2);
  EXPECT_EQ(frame["pairs"][1]["a"], 1);
  EXPECT_EQ(frame["stats"]["named_excluded_pairs"], 1);
  EXPECT_THROW(check_json({.meshes = {a_, b_}, .excluded = {{"a.obj", "c.obj"}}}), UsageError);
  EXPECT_THROW(check_json({.meshes = {a_, b_}, .excluded = {{"a.obj", "a.obj"}}}), UsageError);
}

TEST_F(CheckCommand, FoldersMoveThroughOneWorld) {
  for (int i = 0; i < 4; ++i) {
    folder_.write("seq/" + std::to_string(i) + ".obj", tetrahedron_at(2 - 0.5 * i, 0.1, 0.1));
  }
  const Json frames = check_json({.meshes = {a_, folder_.path() / "seq"}})["frames"];
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[0]["pairs"].size(), 0u);
  EXPECT_EQ(frames[2]["stats"]["fresh_directions"].get<int>() + frames[2]["stats"]["smallest_directions"].get<int>(), 0)
      << "the hulls are apart, x + y + z being at most 1 in one and at least 1.2 in the other";
  EXPECT_EQ(frames[3]["stats"]["contacts"], 1);
  EXPECT_EQ(frames[3]["stats"]["moved_bodies"], 1);
  EXPECT_EQ(check_json({.meshes = {a_, folder_.path() / "seq"}, .frames = 3})["frames"].size(), 3u);
}

TEST_F(CheckCommand, FilesStandStillForAsManyFramesAsAsked) {
  const Json frames = check_json({.meshes = {a_, b_}, .frames = 3})["frames"];
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[2]["frame"], 2);
  EXPECT_EQ(frames[2]["stats"]["moved_bodies"], 0);
  EXPECT_EQ(frames[2]["hash"], frames[0]["hash"]);
}

// Sends the program SIGINT when `text` was written to it.
class InterruptingBuffer : public std::stringbuf {
 public:
  explicit InterruptingBuffer(std::string text) : text_(std::move(text)) {}

 private:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    const std::streamsize written = std::stringbuf::xsputn(bytes, count);
    if (!sent_ && str().find(text_) != std::string::npos) {
      sent_ = true;
      raise(SIGINT);
    }
    return written;
  }

  std::string text_;
  bool sent_ = false;
};

TEST_F(CheckCommand, AnInterruptEndsItAfterTheFrameAndTheReportSaysSo) {
  InterruptingBuffer buffer(R"("frame":1,)");
  std::ostream out(&buffer);
  check({.meshes = {a_, b_}, .frames = 1000000, .json = "-"}, out);
  const Json json = Json::parse(buffer.str());
  EXPECT_EQ(json["frames"].size(), 2u);
  EXPECT_EQ(json["interrupted"], true);
}

TEST_F(CheckCommand, AnInterruptKeepsTheTableAndTheFiles) {
  InterruptingBuffer buffer("frame 2: ");
  std::ostream out(&buffer);
  const auto file = folder_.path() / "report.json";
  check({.meshes = {a_, b_}, .frames = 1000000, .json = file.string()}, out);
  EXPECT_NE(buffer.str().find("\ninterrupted after 3 of 1000000 frames\n\nover 3 frames: "), std::string::npos)
      << buffer.str();
  const Json json = Json::parse(std::ifstream(file));
  EXPECT_EQ(json["frames"].size(), 3u);
  EXPECT_EQ(json["interrupted"], true);
}

TEST_F(CheckCommand, TheTableTellsTheSame) {
  std::ostringstream out;
  check({.meshes = {a_, b_, c_}, .frames = 2}, out);
  const Json frame = check_json({.meshes = {a_, b_, c_}})["frames"][0];
  const std::string count = frame["stats"]["facet_pairs"].dump();
  EXPECT_NE(out.str().find("3 candidate pairs"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find(count + " facet pairs"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("hulls apart in all 2 candidate frames"), std::string::npos) << out.str();
}

TEST_F(CheckCommand, JsonTakesNamesThatAreNotUtf8) {
  const auto odd = folder_.write("odd\xff.obj", tetrahedron_at(0, 0, 0));
  EXPECT_EQ(check_json({.meshes = {odd}})["bodies"][0]["name"], "odd\xef\xbf\xbd.obj");
  std::ostringstream out;
  check({.meshes = {odd}}, out);
  EXPECT_NE(out.str().find("odd"), std::string::npos);
}

}  // namespace
}  // namespace tact::scenes

// `tact run`: what it writes, the same for any number of threads, and how it ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "scenes/commands/run_command.h"
#include "scenes/commands/scenes_command.h"
#include "scenes/commands/usage_error.h"
#include "tests/support/environment/temporary_folder.h"

namespace tact::scenes {
namespace {

std::vector<std::string> lines(const std::filesystem::path& file) {
  std::vector<std::string> result;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

class RunCommand : public ::testing::Test {
 protected:
  std::string printed(const RunOptions& options) const {
    std::ostringstream out;
    run(options, out);
    return out.str();
  }

  tests::TemporaryFolder folder_;
};

TEST_F(RunCommand, SamePicturesForOneAndTwoThreads) {
  struct Short {
    const char* scene;
    int size, frames;
  };
  for (const Short& scene : {Short{"pile", 4, 41}, Short{"cloth-over-sphere", 12, 41}}) {
    for (const int threads : {1, 2}) {
      const auto out = folder_.path() / scene.scene / std::to_string(threads);
      printed({.scene = scene.scene,
               .frames = scene.frames,
               .size = scene.size,
               .threads = threads,
               .outputs = {.out = out, .every = 40}});
    }
    for (const char* name : {"frame_00000.png", "frame_00001.png", "sheet.png"}) {
      const std::string one = tests::contents(folder_.path() / scene.scene / "1" / name);
      EXPECT_GT(one.size(), 10000u) << scene.scene << ' ' << name;
      EXPECT_TRUE(one == tests::contents(folder_.path() / scene.scene / "2" / name)) << scene.scene << ' ' << name;
    }
  }
}

TEST_F(RunCommand, ZonesAreShownWhereTheyAreAskedFor) {
  std::array<std::string, 2> pictures;
  for (const bool zones : {false, true}) {
    const auto out = folder_.path() / (zones ? "with" : "without");
    const std::string text =
        printed({.scene = "clamp", .frames = 61, .outputs = {.out = out, .every = 60, .zones = zones}});
    EXPECT_EQ(text.find("\n  zones ") == std::string::npos, zones) << text;  // in the ledger
    pictures[zones ? 1 : 0] = tests::contents(out / "frame_00001.png");
    EXPECT_GT(pictures[zones ? 1 : 0].size(), 10000u);
  }
  EXPECT_FALSE(pictures[0] == pictures[1]);
}

TEST_F(RunCommand, TotalsNameStepsTimesStagesContactsDepthAndEnergy) {
  const std::string text = printed({.scene = "pile", .frames = 20, .size = 3, .outputs = {.pictures = false}});
  for (const char* part : {"pile\n",
                           "8 bodies",
                           "20 steps, 0.083 s simulated in ",
                           "steps a second",
                           "last step: ",
                           "facet pairs",
                           "facet pairs that ever crossed: ",
                           "kinetic energy: ",
                           " at its peak",
                           "scene: motion",
                           "engine",
                           "1 refresh",
                           "2 sweep",
                           "3 hulls",
                           "4 direction",
                           "5 cull",
                           "6 confirm",
                           "7 report",
                           "scene: contact points",
                           "scene: sleep",
                           "skipped by the engine, a step",
                           "(refresh of a vertex: "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

TEST_F(RunCommand, ScenesOfThePaperShowItsFiguresBesideOurs) {
  for (const char* scene : {"liver-and-tool", "sphere-in-cloth", "wheel-on-ground", "clamp"}) {
    const std::string text = printed({.scene = scene, .frames = 20, .outputs = {.pictures = false}});
    EXPECT_NE(text.find("\nthe paper: "), std::string::npos) << text;
    EXPECT_NE(text.find(" iterations a contact, "), std::string::npos) << text;
    EXPECT_NE(text.find(" of the facets kept"), std::string::npos) << text;
  }
}

TEST_F(RunCommand, ThePaperLevelTellsWhatItLoses) {
  const RunOptions options{.scene = "clamp", .frames = 80, .accuracy = Accuracy::paper, .outputs = {.pictures = false}};
  EXPECT_NE(printed(options).find("facet pairs lost, against the exact answer: "), std::string::npos);
}

TEST_F(RunCommand, FilesForOtherPrograms) {
  const auto file = [&](const char* name) { return folder_.path() / name; };
  const std::string text = printed({.scene = "pile",
                                    .frames = 41,
                                    .size = 5,
                                    .outputs = {.pictures = false,
                                                .every = 10,
                                                .json = file("r.json"),
                                                .contacts = file("contacts.jsonl"),
                                                .gltf = file("pile.glb"),
                                                .vtk = file("vtk")}});
  EXPECT_NE(text.find("pile.glb"), std::string::npos) << text;
  EXPECT_EQ(nlohmann::json::parse(tests::contents(file("r.json")))["frames"].size(), 41u);
  const std::vector<std::string> contacts = lines(file("contacts.jsonl"));
  ASSERT_EQ(contacts.size(), 41u);
  const auto last = nlohmann::json::parse(contacts.back());
  EXPECT_EQ(last["frame"], 40);
  EXPECT_FALSE(last["contacts"].empty());
  EXPECT_TRUE(tests::contents(file("pile.glb")).starts_with("glTF"));
  for (const char* name : {"vtk/pile.pvd", "vtk/pile_00000.vtp", "vtk/pile_00004.vtp"}) {
    EXPECT_TRUE(std::filesystem::exists(file(name))) << name;
  }
}

TEST_F(RunCommand, StatesTellHowEachStepWent) {
  const std::string text =
      printed({.scene = "cloth-over-sphere", .frames = 40, .size = 12, .outputs = {.pictures = false, .states = "-"}});
  std::istringstream in(text);
  std::vector<nlohmann::json> states;
  for (std::string line; std::getline(in, line);) states.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(states.size(), 40u);
  EXPECT_TRUE(states[0]["smallest_gap"].is_null());
  for (std::size_t k = 0; k < states.size(); ++k) {
    const nlohmann::json& state = states[k];
    EXPECT_EQ(state["frame"], k);
    EXPECT_NEAR(state["time"].get<double>(), static_cast<double>(k + 1) / 120.0, 1e-12);
    EXPECT_EQ(state["awake"], 1);
    EXPECT_EQ(state["asleep"], 0);
    EXPECT_EQ(state["facet_pairs"], 0);
    EXPECT_EQ(state["self_facet_pairs"], 0);
  }
  // It falls freely for 0.2 metres, and then lies on the sphere, about both thicknesses above it.
  const double before = states[10]["kinetic_energy"].get<double>(), after = states[20]["kinetic_energy"].get<double>();
  EXPECT_NEAR(after / before, (21.0 * 21.0) / (11.0 * 11.0), 0.5);
  EXPECT_GT(states[39]["contact_points"].get<int>(), 0);
  EXPECT_GT(states[39]["smallest_gap"].get<double>(), 0.002);
  EXPECT_LT(states[39]["smallest_gap"].get<double>(), 0.008 + 0.008);
}

// What a thread did, as the trace tells it: in each other or apart.
void expect_nested(const nlohmann::json& events, int thread) {
  struct Stretch {
    double begin, end;
  };
  constexpr double kRounding = 0.0011;  // microseconds
  std::vector<Stretch> all, open;
  for (const auto& event : events) {
    if (event["ph"] != "X" || event["tid"] != thread) continue;
    all.push_back({event["ts"], event["ts"].get<double>() + event["dur"].get<double>()});
  }
  std::ranges::stable_sort(all, {}, &Stretch::begin);
  for (const Stretch& stretch : all) {
    while (!open.empty() && open.back().end <= stretch.begin + kRounding) open.pop_back();
    if (!open.empty()) {
      ASSERT_LE(stretch.end, open.back().end + kRounding) << "thread " << thread;
    }
    open.push_back(stretch);
  }
}

TEST_F(RunCommand, ATraceTellsOfStepsPhasesStagesAndPairs) {
  const auto file = folder_.path() / "trace.json";
  const std::string text = printed({.scene = "pile",
                                    .frames = 40,
                                    .size = 20,
                                    .threads = 2,
                                    .outputs = {.pictures = false, .trace = file.string()}});
  EXPECT_NE(text.find("trace.json"), std::string::npos) << text;
  const auto events = nlohmann::json::parse(tests::contents(file))["traceEvents"];
  std::map<std::string, double> ms;  // by name, steps together
  std::set<std::string> categories;
  for (const auto& event : events) {
    if (event["ph"] == "M") continue;
    EXPECT_EQ(event["ph"], "X");
    const std::string name = event["name"];
    ms[name.starts_with("step ") ? "step" : name] += 1e-3 * event["dur"].get<double>();
    categories.insert(event["cat"]);
  }
  EXPECT_EQ(categories, (std::set<std::string>{"engine", "pair", "scene", "step"}));
  EXPECT_EQ(events[0]["args"]["name"], "tact run pile");
  EXPECT_EQ(events[2]["name"], "thread_name");
  EXPECT_EQ(events[2]["args"]["name"], "thread 1");
  for (const char* name : {"step", "motion", "contact points", "engine", "sleep", "1 refresh", "detect", "2 sweep",
                           "3-6 narrow phase", "7 report"}) {
    EXPECT_GT(ms[name], 0.0) << name;
  }
  EXPECT_NEAR(ms["motion"] + ms["contact points"] + ms["engine"] + ms["sleep"], ms["step"], 0.1 * ms["step"]);
  EXPECT_LE(ms["1 refresh"] + ms["detect"], ms["engine"]);
  const double stages =
      ms["2 sweep"] + ms["3-6 narrow phase"] + ms["containment"] + ms["points"] + ms["patches"] + ms["7 report"];
  EXPECT_LE(stages, ms["detect"] + 0.01);
  EXPECT_GT(stages, 0.5 * ms["detect"]);
  for (const int thread : {0, 1}) expect_nested(events, thread);
}

// A child is sent the signal as Ctrl-C sends it: it must end with status 0 and whole files.
TEST_F(RunCommand, AnInterruptKeepsWhatWasDone) {
  const std::string out = (folder_.path() / "out.txt").string();
  const std::string json = (folder_.path() / "r.json").string();
  const std::string trace = (folder_.path() / "trace.json").string();
  const pid_t child = fork();
  if (child == 0) {
    if (freopen(out.c_str(), "w", stdout) == nullptr) _exit(3);
    execl(TACT_PROGRAM, TACT_PROGRAM, "run", "pile", "--size", "10", "--frames", "1000000", "--no-pictures", "--json",
          json.c_str(), "--trace", trace.c_str(), static_cast<char*>(nullptr));
    _exit(4);
  }
  ASSERT_GT(child, 0);
  // It has run for a while when its report has grown.
  const std::string part = json + "." + std::to_string(child) + ".part";
  for (int i = 0; i < 1000 && (!std::filesystem::exists(part) || std::filesystem::file_size(part) < 100000); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, SIGINT);
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const auto report = nlohmann::json::parse(tests::contents(json));
  EXPECT_GT(report["frames"].size(), 1u);
  EXPECT_EQ(report["interrupted"], true);
  EXPECT_FALSE(std::filesystem::exists(part));
  EXPECT_GT(nlohmann::json::parse(tests::contents(trace))["traceEvents"].size(), 10u);
  EXPECT_TRUE(tests::contents(out).starts_with("pile, interrupted\n")) << tests::contents(out);
}

TEST_F(RunCommand, WrongUsageIsNamed) {
  const auto message = [](const RunOptions& options) -> std::string {
    std::ostringstream out;
    try {
      run(options, out);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({.scene = "plie"}), "plie: no such scene (tact scenes lists them)");
  EXPECT_EQ(message({.scene = "pile", .size = 4001}), "--size: pile goes from 1 to 4000, not 4001");
  EXPECT_EQ(message({.scene = "clamp", .size = 3}), "--size: clamp has one size only");
  EXPECT_EQ(message({.scene = "pile", .outputs = {.json = "-", .contacts = "-"}}),
            "--json and --contacts: only one of them can go to standard output");
  EXPECT_EQ(message({.scene = "pile", .outputs = {.contacts = "-", .states = "-"}}),
            "--contacts and --states: only one of them can go to standard output");
  EXPECT_EQ(message({.scene = "pile", .outputs = {.gltf = "-"}}),
            "--gltf: an animation goes to a file, not to standard output");
  EXPECT_EQ(message({.scene = "pile", .outputs = {.json = "no/x", .trace = "no/../no/x"}}),
            "--json and --trace: both would be no/../no/x");
  EXPECT_EQ(message({.scene = "pile", .record = "y", .outputs = {.contacts = "y"}}),
            "--contacts and --record: both would be y");
  EXPECT_EQ(message({.scene = "pile", .record = "y", .outputs = {.contacts = "./y"}}),
            "--contacts and --record: both would be y");
}

TEST(ScenesCommand, ListsEverySceneWithItsSizes) {
  std::ostringstream out;
  list_scenes(out);
  for (const char* part : {"cloth-over-sphere", "sphere-into-cloth", "pile", "clamp", "liver-and-tool",
                           "sphere-in-cloth", "wheel-on-ground", "cloth-fold", "ribbon-knot", "net", "surgery",
                           "--size: bodies, 1 to 4000, 100 if not given"}) {
    EXPECT_NE(out.str().find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace tact::scenes

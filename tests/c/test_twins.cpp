// Walks the headers of C++ and of C: no public function, setting, field or error is without its twin.
#include <gtest/gtest.h>
#include <tact/error.h>
#include <tact/tact_c.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/c/header_of_c.h"

namespace tact::tests {
namespace {

std::string without_comments(const std::string& text) {
  const std::string code = std::regex_replace(text, std::regex(R"(/\*[^]*?\*/)"), " ");
  return std::regex_replace(code, std::regex("//[^\n]*"), " ");
}

// Without its comments.
std::string code_of(const std::string& path) {
  std::ifstream file(std::filesystem::path(TACT_SOURCE_DIR) / path);
  EXPECT_TRUE(file) << path;
  return without_comments({std::istreambuf_iterator<char>(file), {}});
}

// What stands between the braces after `head`, without its private part.
std::string body_of(const std::string& text, const std::string& head) {
  const std::size_t begin = text.find(head);
  EXPECT_NE(begin, std::string::npos) << head;
  if (begin == std::string::npos) return {};
  std::size_t end = text.find('{', begin);
  const std::size_t open = end;
  for (int depth = 0; end < text.size(); ++end) {
    depth += text[end] == '{' ? 1 : text[end] == '}' ? -1 : 0;
    if (depth == 0) break;
  }
  const std::string body = text.substr(open + 1, end - open - 1);
  return body.substr(0, body.find("private:"));
}

// The names that are followed by a parenthesis.
std::set<std::string> functions_in(std::string text) {
  text = std::regex_replace(text, std::regex(R"(\{[^{}]*\})"), ";");
  std::set<std::string> names;
  const std::regex function(R"(\b([a-z][a-z_0-9]*)\()");
  for (auto at = std::sregex_iterator(text.begin(), text.end(), function); at != std::sregex_iterator(); ++at) {
    names.insert((*at)[1]);
  }
  return names;
}

// The names that end a declaration that is no function's, whatever their first value.
std::set<std::string> fields_in(std::string text) {
  text = std::regex_replace(text, std::regex(R"(friend[^;]*;)"), "");
  text = std::regex_replace(text, std::regex(R"(=[^;]*;)"), ";");
  text = std::regex_replace(text, std::regex(R"([^;]*\([^;{]*\)[^;{]*(\{[^{}]*\}|;))"), ";");
  std::set<std::string> names;
  const std::regex field(R"(\b([a-z][a-z_0-9]*)\s*(;|\{))");
  for (auto at = std::sregex_iterator(text.begin(), text.end(), field); at != std::sregex_iterator(); ++at) {
    names.insert((*at)[1]);
  }
  return names;
}

const std::string kInterface = "engine/include/tact/";

void expect_twins_of_functions(const std::string& header, const std::string& type, const std::string& prefix,
                               const std::map<std::string, std::string>& renamed) {
  const std::set<std::string> twins = functions_in(without_comments(header_of_c()));
  const std::set<std::string> functions = functions_in(body_of(code_of(kInterface + header), type));
  EXPECT_FALSE(functions.empty());
  for (const std::string& name : functions) {
    const auto found = renamed.find(name);
    const std::string twin = found != renamed.end() ? found->second : prefix + name;
    EXPECT_TRUE(twin.empty() || twins.contains(twin)) << type << "::" << name << " has no " << twin << " in C";
  }
}

void expect_twins_of_fields(const std::string& header, const std::string& type, const std::string& struct_of_c,
                            const std::set<std::string>& absent) {
  const std::string c = body_of(without_comments(header_of_c()), "typedef struct " + struct_of_c + " {");
  const std::set<std::string> fields = fields_in(body_of(code_of(kInterface + header), type));
  EXPECT_FALSE(fields.empty());
  for (const std::string& name : fields) {
    if (absent.contains(name)) continue;
    EXPECT_TRUE(std::regex_search(c, std::regex("\\b" + name + "(_ns)?\\b")))
        << type << "::" << name << " has no twin in C";
  }
}

TEST(TwinsInC, OfTheFunctionsOfWorldAndReport) {
  expect_twins_of_functions("world.h", "class TACT_API World {", "tact_world_",
                            {{"set_observer", "tact_world_record"}});
  expect_twins_of_functions("report.h", "class TACT_API Report {", "tact_report_", {});
  expect_twins_of_functions("recording.h", "class TACT_API RecordingPlayer {", "tact_player_", {{"report", ""}});
  expect_twins_of_functions("motion.h", "class TACT_API MotionReport {", "tact_motion_", {});
  // In C they are fields.
  expect_twins_of_functions(
      "report.h", "struct Contact {", "tact_contact_",
      {{"facet_pairs", ""}, {"touching", ""}, {"patches", "tact_contact_patch"}, {"curves", "tact_contact_curve"}});
}

TEST(TwinsInC, OfEachField) {
  expect_twins_of_fields("settings.h", "struct Settings {", "tact_settings", {"outputs"});
  expect_twins_of_fields("settings.h", "struct Outputs {", "tact_settings", {});
  expect_twins_of_fields("body.h", "struct BodyDefinition {", "tact_body_definition", {});
  expect_twins_of_fields("body.h", "struct PlaneDefinition {", "tact_plane_definition", {});
  expect_twins_of_fields("body.h", "struct Plane {", "tact_plane", {});
  expect_twins_of_fields("body.h", "struct FeatureSettings {", "tact_feature_settings", {});
  expect_twins_of_fields("body.h", "struct FeatureLabels {", "tact_feature_labels", {});
  expect_twins_of_fields("body.h", "struct SelfContactFilter {", "tact_self_contact_filter", {});
  expect_twins_of_fields("body.h", "struct LabelPair {", "tact_label_pair", {});
  expect_twins_of_fields("world.h", "struct MeshUpdate {", "tact_mesh_update", {});
  expect_twins_of_fields("body.h", "struct BodyId {", "tact_body", {});
  expect_twins_of_fields("report.h", "struct Contact {", "tact_contact", {});
  expect_twins_of_fields("report.h", "struct Patch {", "tact_patch", {});
  expect_twins_of_fields("report.h", "struct ZoneDisk {", "tact_zone_disk", {});
  expect_twins_of_fields("report.h", "struct CandidatePair {", "tact_candidate_pair", {});
  expect_twins_of_fields("report.h", "struct ContactEvent {", "tact_contact_event", {});
  expect_twins_of_fields("intersection_curve.h", "struct CurvePoint {", "tact_curve_point", {});
  expect_twins_of_fields("intersection_curve.h", "struct IntersectionCurve {", "tact_curve", {});
  expect_twins_of_fields("world.h", "struct Bounds {", "tact_bounds", {});
  expect_twins_of_fields("world.h", "struct PoseUpdate {", "tact_pose_update", {});
  expect_twins_of_fields("message.h", "struct Message {", "tact_message", {});
  expect_twins_of_fields("recording.h", "struct PlayedStep {", "tact_played_step", {});
  expect_twins_of_fields("debug_draw.h", "struct DebugDrawOptions {", "tact_debug_draw_options", {});
  expect_twins_of_fields("debug_draw.h", "struct DebugColor {", "tact_debug_color", {});
  expect_twins_of_fields("queries.h", "struct Ray {", "tact_ray", {"filter"});
  expect_twins_of_fields("queries.h", "struct RayHit {", "tact_ray_hit", {});
  expect_twins_of_fields("queries.h", "struct PointQuery {", "tact_point_query", {"filter"});
  expect_twins_of_fields("queries.h", "struct ClosestPoint {", "tact_closest_point", {});
  expect_twins_of_fields("queries.h", "struct BoxQuery {", "tact_box_query", {"filter"});
  expect_twins_of_fields("queries.h", "struct FacetOfBody {", "tact_facet_of_body", {});
  expect_twins_of_fields("body_queries.h", "struct DistanceQuery {", "tact_distance_query", {});
  expect_twins_of_fields("body_queries.h", "struct NearestBodiesQuery {", "tact_nearest_bodies_query", {"filter"});
  expect_twins_of_fields("body_queries.h", "struct BodyDistance {", "tact_body_distance", {});
  expect_twins_of_fields("body_queries.h", "struct Sweep {", "tact_sweep", {"filter"});
  expect_twins_of_fields("body_queries.h", "struct SweepHit {", "tact_sweep_hit", {});
  expect_twins_of_fields("body_queries.h", "struct Overlap {", "tact_overlap", {});
  for (const auto& [type, twin] : {std::pair("PointArrays", "tact_point_arrays"),
                                   {"FacetPairArrays", "tact_facet_pair_arrays"},
                                   {"PointLabelArrays", "tact_point_label_arrays"},
                                   {"ReachPairArrays", "tact_reach_pair_arrays"},
                                   {"ImpactArrays", "tact_impact_arrays"}})
    expect_twins_of_fields("report_arrays.h", "struct " + std::string(type) + " {", twin, {});
  expect_twins_of_fields("joined_minima.h", "struct JoinedSurfaces {", "tact_joined_surfaces", {});
  expect_twins_of_fields("contact_sums.h", "struct ContactSum {", "tact_contact_sum", {"vertices"});
  expect_twins_of_fields("contact_sums.h", "struct PointImpulse {", "tact_point_impulse", {});
  expect_twins_of_fields("contact_sums.h", "struct VertexOfBody {", "tact_vertex_of_body", {});
  expect_twins_of_fields("solver/stencil.h", "struct Stencil {", "tact_stencil", {});
  expect_twins_of_fields("motion.h", "struct MotionOptions {", "tact_motion_options", {});
  expect_twins_of_fields("motion.h", "struct Impact {", "tact_impact", {});
  expect_twins_of_fields("motion.h", "struct ImpactPair {", "tact_impact_pair", {});
  expect_twins_of_fields("motion.h", "struct MotionStats {", "tact_motion_statistics", {});
  expect_twins_of_fields("weld.h", "struct WeldedMesh {", "tact_welded_mesh", {});
}

TEST(TwinsInC, OfEachError) {
  const std::string c = without_comments(header_of_c());
  for (const int none : {std::numeric_limits<int>::min(), -1, std::numeric_limits<int>::max()})
    EXPECT_STREQ(tact_error_code_name(none), "unknown");
  for (int code = 0; std::string(error_code_name(ErrorCode(code))) != "unknown"; ++code) {
    const std::string name = error_code_name(ErrorCode(code));
    std::string twin = "TACT_ERROR_";
    for (const char letter : name) twin += static_cast<char>(std::toupper(letter));
    EXPECT_TRUE(std::regex_search(c, std::regex("\\b" + twin + " = " + std::to_string(code + 1) + "\\b"))) << twin;
    EXPECT_EQ(tact_error_code_name(code + 1), name);
  }
}

// A header without twins is found: the test can fail.
TEST(TwinsInC, AreMissedWhereThereAreNone) {
  EXPECT_EQ(functions_in("void f(int); int g() const { return h(); }"), (std::set<std::string>{"f", "g"}));
  EXPECT_EQ(fields_in("double x = 1.0; int y; bool f() const { return x; } Vector z = Vector::Zero();"),
            (std::set<std::string>{"x", "y", "z"}));
  EXPECT_EQ(body_of("struct A { int x; struct { int y; } z; private: int w; };", "struct A {"),
            " int x; struct { int y; } z; ");
}

}  // namespace
}  // namespace tact::tests

// The comments of C and of Python's stubs say what those of C++ do. What is compared is the first sentence of a twin
// that has one, after one rewriting of the C++ sentence, stated in `in_c` and `in_python`.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/c/header_of_c.h"

namespace tact::tests {
namespace {

using Sentences = std::map<std::string, std::string>;

std::string text_of(const std::string& path) {
  std::ifstream file(std::filesystem::path(TACT_SOURCE_DIR) / path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

// Without its period, in single spaces.
std::string first_sentence(const std::string& comment) {
  std::string text = std::regex_replace(comment, std::regex(R"(\s+)"), " ");
  text = std::regex_replace(text, std::regex("^ +| +$"), "");
  std::smatch end;
  if (std::regex_search(text, end, std::regex(R"(\.(?= [A-Z`{(]| *$))"))) text = end.prefix();
  return text;
}

std::string without_returns(const std::string& sentence) {
  return std::regex_replace(sentence, std::regex("^[Rr]eturns "), "");
}

// A sentence without what differs between a comment of its own and one after a field.
std::string plain(std::string sentence) {
  sentence = without_returns(sentence);
  if (!sentence.empty()) sentence[0] = static_cast<char>(std::tolower(sentence[0]));
  return sentence;
}

// The sentences of a header by qualified name: comments before a declaration, or after it on its line.
Sentences sentences_in(const std::string& header, const std::string& before, const std::string& after) {
  Sentences found;
  std::vector<std::string> context;
  std::string pending, continued;
  std::istringstream lines(header);
  const std::regex type(R"((?:typedef )?(?:enum class|enum|struct|class) (?:TACT_API )?(\w+)[^;]*\{$)"),
      function(R"(\b(~?[a-z_]\w*)\()"), field(R"((\w+)(?:\[\d\])?(?:\{.*\}| = [^;]*)?[,;]?$)");
  for (std::string line; std::getline(lines, line);) {
    line = std::regex_replace(line, std::regex("^ +"), "");
    if (line.starts_with(after)) {
      if (!continued.empty()) found[continued] = first_sentence(found[continued] + " " + line.substr(after.size()));
      continue;
    }
    if (line + " " == before) {  // what follows is another paragraph, or code
      pending += "` ";
      continue;
    }
    if (line.starts_with(before)) {
      pending += line.substr(before.size()) + " ";
      continue;
    }
    std::string trailing;
    if (const std::size_t at = line.find(after); at != std::string::npos) {
      trailing = line.substr(at + after.size());
      line = std::regex_replace(line.substr(0, at), std::regex(" +$"), "");
    }
    line = std::regex_replace(line, std::regex(" = [^;]*;$"), ";");
    continued.clear();
    const std::string comment = pending.empty() ? trailing : pending;
    pending.clear();
    std::string scope;
    for (const std::string& one : context) scope += one + "::";
    std::smatch match;
    if (std::regex_search(line, match, type)) {
      if (!comment.empty()) found.emplace(match[1], first_sentence(comment));
      context.push_back(match[1]);
    } else if (line.starts_with("}") && !context.empty() && !line.ends_with("\\")) {
      context.pop_back();
    } else if (!comment.empty() && (std::regex_search(line, match, function) ||
                                    (line.find('(') == std::string::npos && std::regex_search(line, match, field)))) {
      const std::string name = scope + match[1].str();
      if (found.emplace(name, first_sentence(comment)).second && !trailing.empty()) continued = name;
    }
  }
  return found;
}

Sentences sentences_of_cpp() {
  Sentences all;
  for (const char* header : {"body", "body_queries", "contact_point", "contact_sums", "debug_draw",
                             "intersection_curve", "joined_minima", "message", "motion", "queries", "recording",
                             "report", "report_arrays", "settings", "solver/stencil", "surface_check", "weld", "world"})
    all.merge(sentences_in(text_of("engine/include/tact/" + std::string(header) + ".h"), "/// ", "///< "));
  for (const char* header : {"error", "facet_pair", "feature_pair", "reach_pair"})
    all.merge(sentences_in(text_of("engine/base/include/tact/" + std::string(header) + ".h"), "/// ", "///< "));
  return all;
}

// A comment of C in the form of C++: every line of it begins with "/// ", or it stands after "///< ".
std::string with_lines_of_cpp(std::string text) {
  text = std::regex_replace(text, std::regex(R"(/\*\*< ?)"), "///< ");
  std::string result;
  bool inside = false, trailing = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const std::size_t begin = line.find("/** "); begin != std::string::npos) {
      inside = true;
      line.replace(begin, 4, "/// ");
    } else if (const std::size_t at = line.find("///< "); at != std::string::npos) {
      inside = trailing = true;
    } else if (inside) {
      line = (trailing ? "///< " : "/// ") + std::regex_replace(line, std::regex(R"(^ *\*? *(?!/))"), "");
    }
    if (const std::size_t end = line.find("*/"); end != std::string::npos && inside) {
      line.erase(end);
      inside = trailing = false;
    }
    result += line + "\n";
  }
  return result;
}

// C++ type, type of C, prefix of its functions or constants.
struct Twin {
  const char* cpp;
  const char* c;
  const char* prefix;
};
constexpr Twin kTwins[] = {
    {"World", "tact_world", "tact_world_"},
    {"Report", "", "tact_report_"},
    {"RecordingPlayer", "tact_player", "tact_player_"},
    {"MotionReport", "", "tact_motion_"},
    {"Contact", "tact_contact", "tact_contact_"},
    {"ErrorCode", "tact_error", "TACT_ERROR_"},
    {"Accuracy", "tact_accuracy", "TACT_ACCURACY_"},
    {"DirectionPolicy", "tact_direction_policy", "TACT_DIRECTION_"},
    {"Surface", "tact_surface", "TACT_SURFACE_"},
    {"Motion", "tact_motion", "TACT_MOTION_"},
    {"MessageKind", "tact_message_kind", "TACT_MESSAGE_"},
    {"DirectionSource", "tact_direction_source", "TACT_SOURCE_"},
    {"Containment", "tact_containment", "TACT_CONTAINMENT_"},
    {"FeaturePair", "tact_feature_pair", "TACT_"},
    {"Impacts", "tact_impacts", "TACT_IMPACTS_"},
    {"RayHits", "tact_ray_hits", "TACT_RAY_"},
    {"BodyId", "tact_body", ""},
    {"Message", "tact_message", ""},
    {"Settings", "tact_settings", ""},
    {"Outputs", "tact_settings", ""},
    {"BodyDefinition", "tact_body_definition", ""},
    {"PlaneDefinition", "tact_plane_definition", ""},
    {"Plane", "tact_plane", ""},
    {"FeatureSettings", "tact_feature_settings", ""},
    {"FeatureLabels", "tact_feature_labels", ""},
    {"SelfContactFilter", "tact_self_contact_filter", ""},
    {"LabelKind", "tact_label_kind", "TACT_LABEL_"},
    {"LabelPair", "tact_label_pair", ""},
    {"MeshUpdate", "tact_mesh_update", ""},
    {"PositionsUpdate", "tact_positions_update", ""},
    {"PoseUpdate", "tact_pose_update", ""},
    {"Bounds", "tact_bounds", ""},
    {"PlayedStep", "tact_played_step", ""},
    {"FacetPair", "tact_facet_pair", ""},
    {"ZoneDisk", "tact_zone_disk", ""},
    {"Patch", "tact_patch", ""},
    {"ContactPoint", "tact_contact_point", ""},
    {"CurvePoint", "tact_curve_point", ""},
    {"IntersectionCurve", "tact_curve", ""},
    {"CandidatePair", "tact_candidate_pair", ""},
    {"ContactEvent", "tact_contact_event", ""},
    {"PatchEvent", "tact_patch_event", ""},
    {"VertexOfBody", "tact_vertex_of_body", ""},
    {"PointImpulse", "tact_point_impulse", ""},
    {"ContactSum", "tact_contact_sum", ""},
    {"PointArrays", "tact_point_arrays", ""},
    {"FacetPairArrays", "tact_facet_pair_arrays", ""},
    {"PointLabelArrays", "tact_point_label_arrays", ""},
    {"JoinedSurfaces", "tact_joined_surfaces", ""},
    {"ReachPair", "tact_reach_pair", ""},
    {"ReachPairArrays", "tact_reach_pair_arrays", ""},
    {"ImpactArrays", "tact_impact_arrays", ""},
    {"StencilKind", "tact_stencil_kind", "TACT_STENCIL_"},
    {"Stencil", "tact_stencil", ""},
    {"MotionOptions", "tact_motion_options", ""},
    {"Impact", "tact_impact", ""},
    {"ImpactPair", "tact_impact_pair", ""},
    {"MotionStats", "tact_motion_statistics", ""},
    {"Ray", "tact_ray", ""},
    {"RayHit", "tact_ray_hit", ""},
    {"PointQuery", "tact_point_query", ""},
    {"ClosestPoint", "tact_closest_point", ""},
    {"BoxQuery", "tact_box_query", ""},
    {"FacetOfBody", "tact_facet_of_body", ""},
    {"DistanceQuery", "tact_distance_query", ""},
    {"NearestBodiesQuery", "tact_nearest_bodies_query", ""},
    {"BodyDistance", "tact_body_distance", ""},
    {"Sweep", "tact_sweep", ""},
    {"SweepHit", "tact_sweep_hit", ""},
    {"Overlap", "tact_overlap", ""},
    {"DebugColor", "tact_debug_color", ""},
    {"DebugDrawer", "tact_debug_drawer", ""},
    {"DebugDrawOptions", "tact_debug_draw_options", ""},
    {"WeldedMesh", "tact_welded_mesh", ""},
};

std::string upper(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::toupper(letter));
  return text;
}

// The name in C of `Type::member`, as a call or not.
std::string name_in_c(const std::string& type, const std::string& member, bool call, const std::string& header) {
  for (const Twin& twin : kTwins) {
    if (type != twin.cpp) continue;
    const std::string prefix = twin.prefix;
    if (prefix.starts_with("TACT_") && !call) return prefix + upper(member);
    if (call && type == "Contact" && member == "patches") return "tact_contact_patch()";
    if (call && type == "Contact" && member == "curves") return "tact_contact_curve()";
    if (call && header.find(" " + prefix + member + "(") != std::string::npos) return prefix + member + "()";
    return std::string(twin.c) + "." + member;
  }
  return type + "::" + member;
}

// The rewriting for C: what a function returns it gives through its last argument, and names are those of C.
std::string in_c(const std::string& sentence, const std::string& header) {
  std::string rest = std::regex_replace(sentence, std::regex("^Returns "), "Gives "), result;
  std::smatch match;
  const std::regex name(R"((?:\b([A-Z]\w*)::|\b)([a-z]\w*)(\(\))?)");
  while (std::regex_search(rest, match, name)) {
    const bool call = match[3].matched;
    std::string twin = match[0];
    if (match[1].matched) {
      twin = name_in_c(match[1], match[2], call, header);
    } else if (call && header.find(" tact_world_" + match[2].str() + "(") != std::string::npos) {
      twin = "tact_world_" + twin;
    }
    result += match.prefix().str() + twin;
    rest = match.suffix();
  }
  return std::regex_replace(result + rest, std::regex("kLargestCoordinate"), "2^300");
}

// The rewriting for Python: names are Python's, null is None, properties are no calls, and `from` is a keyword.
std::string in_python(std::string sentence) {
  sentence = std::regex_replace(sentence, std::regex(R"(\bOutputs::)"), "Settings::");
  sentence = std::regex_replace(sentence, std::regex("::"), ".");
  sentence = std::regex_replace(sentence, std::regex(R"(\b(Contact\.\w+|Report\.(?!hash|find)\w+)\(\))"), "$1");
  sentence = std::regex_replace(sentence, std::regex(R"(\bfrom \+)"), "from_ +");
  sentence = std::regex_replace(sentence, std::regex(R"(- from\))"), "- from_)");
  sentence = std::regex_replace(sentence, std::regex(R"(\bnull\b)"), "None");
  return std::regex_replace(sentence, std::regex("kLargestCoordinate"), "LARGEST_COORDINATE");
}

// A comment that is but the name of a type, as of the numbers that stand for enumerations.
bool names_a_type(const std::string& sentence) { return std::regex_match(sentence, std::regex(R"(tact_\w+ *)")); }

TEST(TwinSentences, OfC) {
  const std::string header = header_of_c();
  const Sentences cpp = sentences_of_cpp(), c = sentences_in(with_lines_of_cpp(header), "/// ", "///< ");
  int compared = 0;
  for (const auto& [name, sentence] : cpp) {
    const std::size_t colons = name.rfind("::");
    const std::string type = name.substr(0, colons),
                      member = colons == std::string::npos ? "" : name.substr(colons + 2);
    for (const Twin& twin : kTwins) {
      if (type != twin.cpp) continue;
      const std::string prefix = twin.prefix;
      std::vector<std::string> places{std::string(twin.c) + (member.empty() ? "" : "::" + member)};
      if (!member.empty() && !prefix.empty()) {
        places.push_back(prefix + member);
        places.push_back(std::string(twin.c) + "::" + prefix + upper(member));
      }
      for (const std::string& place : places) {
        const auto found = c.find(place);
        if (found == c.end() || names_a_type(found->second) || place == "tact_settings") continue;
        ++compared;
        const bool is_field = place.find("::") != std::string::npos;
        const std::string expected = in_c(is_field ? without_returns(sentence) : sentence, header);
        EXPECT_EQ(plain(found->second), plain(expected)) << place << ", the twin of " << name;
      }
    }
  }
  EXPECT_GT(compared, 200);
}

// The sentences of the stubs by qualified name, without the shapes of arrays before them.
Sentences sentences_of_stubs() {
  Sentences found;
  std::istringstream lines(text_of("bindings/python/tact/__init__.pyi"));
  std::string type, member;
  const std::regex declaration(R"(^( *)(?:class|def) (\w+)|^( +)(\w+): )"), comment(R"re(^ *"""(.*)""")re");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, declaration)) {
      const std::string name = match[2].matched ? match[2] : match[4];
      const bool inside = match[1].length() + match[3].length() == 4;
      if (match[2].matched && match[1].length() == 0) type = name, member.clear();
      if (inside) member = name;
    } else if (std::regex_search(line, match, comment)) {
      std::string text = std::regex_replace(match[1].str(), std::regex(R"(^\([NVFC234, ]+\)[a-z0-9 ]*[:;,]? ?)"), "");
      found.emplace(type + (member.empty() ? "" : "::" + member), first_sentence(text));
    }
  }
  return found;
}

TEST(TwinSentences, OfPython) {
  // A row an answer, under the plural of the name that one answer has.
  const std::map<std::string, std::string> rows{{"ContactPoints", "ContactPoint"}, {"RayHits", "RayHit"},
                                                {"ClosestPoints", "ClosestPoint"}, {"Stencils", "Stencil"},
                                                {"ContactSums", "ContactSum"},     {"MotionReport", "Impact"},
                                                {"ReachPairs", "ReachPair"},       {"BodyDistances", "BodyDistance"},
                                                {"SweepHits", "SweepHit"}};
  // What has another meaning in Python, which has arrays where C++ has structs.
  const std::set<std::string> others{"RayHits",
                                     "RayHits::bodies",
                                     "RayHits::facets",
                                     "ClosestPoints::bodies",
                                     "ClosestPoints::facets",
                                     "BodyDistances::facets",
                                     "SweepHits::bodies",
                                     "SweepHits::others",
                                     "MotionReport::bodies",
                                     "MotionReport::kinds",
                                     "ContactPoints::kinds",
                                     "ReachPairs::kinds",
                                     "Stencils::kinds",
                                     "ContactSums::kinds",
                                     "ContactSums::vertices"};
  const Sentences cpp = sentences_of_cpp(), python = sentences_of_stubs();
  int compared = 0;
  for (const auto& [name, sentence] : python) {
    const std::size_t colons = name.find("::");
    const std::string type = name.substr(0, colons), member = colons == std::string::npos ? "" : name.substr(colons);
    auto twin = cpp.find(name);
    if (const auto of_row = rows.find(type); of_row != rows.end() && twin == cpp.end()) {
      const std::string plural = of_row->second + member;
      twin = cpp.find(plural);
      for (const std::string end : {"es", "s"}) {
        if (twin == cpp.end() && plural.ends_with(end)) twin = cpp.find(plural.substr(0, plural.size() - end.size()));
      }
    }
    if (type == "Settings" && twin == cpp.end()) twin = cpp.find("Outputs" + member);
    if (type == "PatchEventKind") twin = cpp.find("PatchEvent::Kind" + member);
    if (twin == cpp.end() || others.contains(name)) continue;
    ++compared;
    EXPECT_EQ(plain(sentence), plain(in_python(twin->second))) << name;
  }
  EXPECT_GT(compared, 60);
}

// Sentences that differ are found: the tests can fail.
TEST(TwinSentences, AreReadAndRewritten) {
  const std::string header =
      "/// A body. It is\n/// large.\nstruct Body {\n  int x = 0;  ///< metres; negative\n"
      "              ///< where empty\n  /// Returns y. Errors: none.\n  int y() const;\n};\n";
  EXPECT_EQ(sentences_in(header, "/// ", "///< "),
            (Sentences{{"Body", "A body"}, {"Body::x", "metres; negative where empty"}, {"Body::y", "Returns y"}}));
  EXPECT_EQ(with_lines_of_cpp("/** A\n *  b. */\nint x; /**< c\n  d */\n"), "/// A\n/// b. \nint x; ///< c\n///< d \n");
  EXPECT_EQ(
      in_c("Returns what World::detect() found at Accuracy::hulls: a <= kLargestCoordinate", " tact_world_detect("),
      "Gives what tact_world_detect() found at TACT_ACCURACY_HULLS: a <= 2^300");
  EXPECT_EQ(in_python("null, if Outputs::points is set: from + t * (to - from)"),
            "None, if Settings.points is set: from_ + t * (to - from_)");
}

}  // namespace
}  // namespace tact::tests

#include "scenes/commands/report_json.h"

#include <fmt/format.h>
#include <tact/version.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "engine/facet_outcomes.h"
#include "scenes/commands/json_text.h"
#include "scenes/commands/surface_report.h"

namespace tact::scenes {
namespace {

Json to_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json bodies_json(const World& world, JsonReport::Surfaces surfaces, const std::vector<Weld>& welds) {
  Json bodies = Json::array();
  for (const BodyId body : world.bodies()) {
    bodies.push_back({{"name", world.name(body)},
                      {"vertices", world.vertex_count(body)},
                      {"facets", world.facet_count(body)},
                      {"surface", surface_name(world.surface(body))}});
    if (surfaces == JsonReport::Surfaces::checked) bodies.back()["check"] = surface_json(world.check_surface(body));
    if (bodies.size() > welds.size()) continue;
    const Weld& weld = welds[bodies.size() - 1];
    bodies.back()["merged_vertices"] = weld.merged_vertices;
    bodies.back()["collapsed_facets"] = weld.collapsed_facets;
  }
  return bodies;
}

Json facet_pairs_json(const Contact& contact) {
  Json pairs = Json::array();
  for (const FacetPair& pair : contact.facet_pairs()) pairs.push_back(Json::array({pair.a, pair.b}));
  return pairs;
}

template <class Number>
Json first_of(const std::array<Number, 3>& values, std::size_t count) {
  Json json = Json::array();
  for (std::size_t k = 0; k < count; ++k) json.push_back(values[k]);
  return json;
}

std::size_t count_of(const std::array<int, 3>& vertices) {
  return static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), [](int v) { return v >= 0; }));
}

Json impacts_json(const MotionReport& motion) {
  Json impacts = Json::array();
  for (const Impact& impact : motion.impacts()) {
    impacts.push_back({{"bodies", Json::array({impact.a.index, impact.b.index})},
                       {"kind", feature_pair_name(impact.kind)},
                       {"a", first_of(impact.a_vertices, count_of(impact.a_vertices))},
                       {"b", first_of(impact.b_vertices, count_of(impact.b_vertices))},
                       {"time", impact.time},
                       {"stops", impact.stops}});
  }
  return impacts;
}

Json point_json(const ContactPoint& point) {
  const std::size_t of_a = count_of(point.a_vertices), of_b = count_of(point.b_vertices);
  return {{"kind", feature_pair_name(point.kind)},
          {"a", first_of(point.a_vertices, of_a)},
          {"b", first_of(point.b_vertices, of_b)},
          {"a_weights", first_of(point.a_weights, of_a)},
          {"b_weights", first_of(point.b_weights, of_b)},
          {"normal", to_json(point.normal)},
          {"gap", point.gap},
          {"minimum", point.minimum},
          {"patch", point.patch}};
}

Json points_json(const Contact* contact) {
  Json points = Json::array();
  if (contact == nullptr) return points;
  for (const ContactPoint& point : contact->points()) points.push_back(point_json(point));
  return points;
}

Json patches_json(const Contact* contact) {
  Json patches = Json::array();
  if (contact == nullptr) return patches;
  for (const Patch& patch : contact->patches()) {
    Json spanning = Json::array();
    for (const int i : patch.spanning) {
      if (i >= 0) spanning.push_back(i);
    }
    patches.push_back({{"id", fmt::format("{:016x}", patch.id)},
                       {"point", to_json(patch.point)},
                       {"direction", to_json(patch.direction)},
                       {"depth", patch.depth},
                       {"area", patch.area},
                       {"points", patch.points},
                       {"spanning", spanning}});
  }
  return patches;
}

Json curves_json(const Contact* contact) {
  Json curves = Json::array();
  if (contact == nullptr) return curves;
  for (const IntersectionCurve& curve : contact->curves()) {
    Json points = Json::array(), facets = Json::array();
    for (const CurvePoint& point : curve.points) {
      points.push_back(to_json(point.position));
      if (point.facet_pair < 0) continue;
      const FacetPair pair = contact->facet_pairs()[static_cast<std::size_t>(point.facet_pair)];
      facets.push_back(Json::array({pair.a, pair.b}));
    }
    curves.push_back({{"closed", curve.closed}, {"points", points}, {"facets", facets}});
  }
  return curves;
}

const char* outcome_name(FacetOutcome outcome) {
  switch (outcome) {
    case FacetOutcome::outside_box: return "outside_box";
    case FacetOutcome::outside_slab: return "outside_slab";
    case FacetOutcome::far: return "far";
    case FacetOutcome::facing_away: return "facing_away";
    case FacetOutcome::outside_zone: return "outside_zone";
    case FacetOutcome::kept: return "kept";
    case FacetOutcome::meets: return "meets";
  }
  return "unknown";
}

// How many facets had each outcome.
Json outcomes_json(const std::vector<FacetOutcome>& outcomes) {
  std::array<std::int64_t, kFacetOutcomes> counts{};
  for (const FacetOutcome outcome : outcomes) ++counts[static_cast<std::size_t>(outcome)];
  Json json = Json::object();
  for (std::size_t i = 0; i < counts.size(); ++i) json[outcome_name(static_cast<FacetOutcome>(i))] = counts[i];
  return json;
}

// What is told of a pair.
struct PairParts {
  bool facets = false;
  bool points = false;
  bool curves = false;
  bool within_reach = false;
  FacetOutcomeFinder* finder = nullptr;  // null: no outcomes
};

// A body with itself has no direction.
Json self_json(const Contact& contact, const PairParts& parts) {
  Json json = {{"a", contact.a.index}, {"b", contact.b.index}};
  json["facet_pairs"] = parts.facets ? facet_pairs_json(contact) : Json(nullptr);
  if (parts.points) {
    json["point_limit_reached"] = contact.point_limit_reached;
    json["points"] = points_json(&contact);
    json["patches"] = patches_json(&contact);
  }
  if (parts.curves) json["curves"] = curves_json(&contact);
  if (parts.within_reach) json["within_reach"] = contact.within_reach().size();
  return json;
}

// `contact` is null if the pair is not in contact.
Json pair_json(const CandidatePair& pair, const Contact* contact, const PairParts& parts) {
  Json json = {{"a", pair.a.index}, {"b", pair.b.index}, {"hulls_overlap", pair.hulls_overlap}};
  if (contact != nullptr) {
    json["direction"] = to_json(contact->direction);
    json["depth"] = contact->depth;
    json["source"] = direction_source_name(contact->source);
    json["iterations"] = contact->iterations;
    json["limit_reached"] = contact->limit_reached;
    json["kept_facets"] = Json::array({contact->kept_facets_a, contact->kept_facets_b});
    if (contact->containment != Containment::none)
      json["contained"] = contact->containment == Containment::a_in_b ? "a" : "b";
    const std::optional<FacetOutcomes> outcomes = parts.finder != nullptr ? parts.finder->find(*contact) : std::nullopt;
    if (outcomes) json["outcomes"] = Json::array({outcomes_json(outcomes->a), outcomes_json(outcomes->b)});
  }
  if (!parts.facets) {
    json["facet_pairs"] = nullptr;
  } else {
    json["facet_pairs"] = contact != nullptr ? facet_pairs_json(*contact) : Json::array();
  }
  if (parts.points) {
    json["points"] = points_json(contact);
    json["patches"] = patches_json(contact);
  }
  if (parts.curves) json["curves"] = curves_json(contact);
  if (parts.within_reach) json["within_reach"] = contact != nullptr ? contact->within_reach().size() : 0;
  return json;
}

// Candidates and bodies in contact with themselves, both sorted, merged.
Json pairs_json(const Report& report, const PairParts& parts) {
  Json pairs = Json::array();
  auto contact = report.contacts().begin();
  const auto end = report.contacts().end();
  const auto add_selves_to = [&](BodyId body) {
    for (; contact != end && contact->a == contact->b && !(body < contact->a); ++contact)
      pairs.push_back(self_json(*contact, parts));
  };
  for (const CandidatePair& pair : report.candidate_pairs()) {
    add_selves_to(pair.a);
    const bool found = contact != end && contact->a == pair.a && contact->b == pair.b;
    pairs.push_back(pair_json(pair, found ? &*contact++ : nullptr, parts));
  }
  if (contact != end) add_selves_to(report.contacts().back().a);
  return pairs;
}

Json stats_json(const StepStats& stats) {
  Json counts = Json::object();
  for_each_count(stats, [&](const char* name, const char* /*text*/, std::int64_t count) { counts[name] = count; });
  return counts;
}

Json times_json(const StepStats& stats) {
  Json times = Json::object();
  for_each_time(stats, [&](std::string_view name, const char* /*text*/, double time) {
    times[std::string(name.substr(0, name.rfind("_ms")))] = time;
  });
  return times;
}

}  // namespace

std::string accuracy_name(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::hulls: return "hulls";
    case Accuracy::paper: return "paper";
    case Accuracy::exact: return "exact";
  }
  return "unknown";
}

std::string surface_name(Surface surface) { return surface == Surface::closed ? "closed" : "sheet"; }

std::string direction_source_name(DirectionSource source) {
  switch (source) {
    case DirectionSource::carried: return "carried";
    case DirectionSource::fresh: return "fresh";
    case DirectionSource::smallest: return "smallest";
  }
  return "unknown";
}

std::string feature_pair_name(FeaturePair kind) {
  switch (kind) {
    case FeaturePair::vertex_facet: return "vertex-facet";
    case FeaturePair::facet_vertex: return "facet-vertex";
    case FeaturePair::edge_edge: return "edge-edge";
    case FeaturePair::vertex_edge: return "vertex-edge";
    case FeaturePair::edge_vertex: return "edge-vertex";
    case FeaturePair::vertex_vertex: return "vertex-vertex";
    case FeaturePair::vertex_plane: return "vertex-plane";
    case FeaturePair::plane_vertex: return "plane-vertex";
  }
  return "unknown";
}

std::string hash_text(const Report& report) { return fmt::format("{:016x}", report.hash()); }

JsonReport::JsonReport(std::ostream& out, const World& world, Outcomes outcomes, Surfaces surfaces,
                       const std::vector<Weld>& welds)
    : out_(out),
      has_facets_(world.settings().accuracy != Accuracy::hulls),
      has_points_(world.settings().outputs.points),
      has_curves_(world.settings().outputs.curves),
      has_within_reach_(world.settings().outputs.within_reach),
      outcomes_(outcomes) {
  out_ << "{\"tact\":" << json_text(TACT_VERSION)
       << ",\"accuracy\":" << json_text(accuracy_name(world.settings().accuracy))
       << ",\"threads\":" << world.settings().threads
       << ",\n \"bodies\":" << json_text(bodies_json(world, surfaces, welds)) << ",\n \"frames\":[";
}

void JsonReport::add_frame(int frame, const Report& report, const MotionReport* motion,
                           const std::vector<std::string>& files, std::optional<double> time) {
  std::optional<FacetOutcomeFinder> finder;
  if (outcomes_ == Outcomes::counts) finder.emplace(report);
  const PairParts parts{.facets = has_facets_,
                        .points = has_points_,
                        .curves = has_curves_,
                        .within_reach = has_within_reach_,
                        .finder = finder ? &*finder : nullptr};
  Json json = {{"frame", frame},
               {"hash", hash_text(report)},
               {"pairs", pairs_json(report, parts)},
               {"stats", stats_json(report.stats())},
               {"times_ms", times_json(report.stats())}};
  if (motion != nullptr) {
    json["impacts"] = impacts_json(*motion);
    json["first_time"] = motion->first_time() <= 1.0 ? Json(motion->first_time()) : Json(nullptr);
  }
  if (time) json["time"] = *time;
  if (!files.empty()) json["files"] = files;
  out_ << (first_ ? "\n" : ",\n") << json_text(json);
  first_ = false;
}

void JsonReport::finish(Ending ending) {
  out_ << (ending == Ending::interrupted ? "],\n \"interrupted\":true}\n" : "]}\n");
}

}  // namespace tact::scenes

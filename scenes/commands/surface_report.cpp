#include "scenes/commands/surface_report.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "scenes/commands/counted.h"

namespace tact::scenes {
namespace {

// How many places of a fault a line names.
constexpr std::size_t kNamedPlaces = 4;

std::string place_text(int number) { return fmt::to_string(number); }
std::string place_text(const std::array<int, 2>& two) { return fmt::format("{}-{}", two[0], two[1]); }
std::string place_text(const FacetPair& two) { return fmt::format("{}-{}", two.a, two.b); }

// "    border edges                   4: 0-1, 1-2, 2-3, 0-3"
template <class Place>
void print_fault(std::ostream& out, const char* name, const std::vector<Place>& places) {
  if (places.empty()) return;
  std::string text;
  for (std::size_t i = 0; i < std::min(places.size(), kNamedPlaces); ++i)
    text += (i == 0 ? "" : ", ") + place_text(places[i]);
  if (places.size() > kNamedPlaces) text += ", ...";
  fmt::print(out, "    {:<26}{:>6}: {}\n", name, places.size(), text);
}

std::vector<int> inside_out_of(const SurfaceCheck& check) {
  std::vector<int> facets;
  for (const SurfaceComponent& one : check.components) {
    if (one.inside_out) facets.push_back(one.facet);
  }
  return facets;
}

Json pairs_json(const std::vector<std::array<int, 2>>& pairs) {
  Json json = Json::array();
  for (const std::array<int, 2>& pair : pairs) json.push_back(pair);
  return json;
}

}  // namespace

Json surface_json(const SurfaceCheck& check) {
  Json components = Json::array(), crossings = Json::array();
  for (const SurfaceComponent& one : check.components) {
    components.push_back(
        {{"facet", one.facet}, {"facets", one.facet_count}, {"closed", one.closed}, {"inside_out", one.inside_out}});
  }
  for (const FacetPair& pair : check.crossings) crossings.push_back(Json::array({pair.a, pair.b}));
  return {{"solid", check.is_solid()},
          {"components", components},
          {"border_edges", pairs_json(check.border_edges)},
          {"branching_edges", pairs_json(check.branching_edges)},
          {"turned_facets", check.turned_facets},
          {"crossings", crossings},
          {"repeated_facets", pairs_json(check.repeated_facets)},
          {"repeated_vertices", pairs_json(check.repeated_vertices)},
          {"slivers", check.slivers},
          {"unused_vertices", check.unused_vertices}};
}

void print_surfaces(std::ostream& out, const World& world) {
  fmt::print(out, "surfaces; edges by their vertices, the rest by facets unless said\n");
  for (const BodyId body : world.bodies()) {
    const SurfaceCheck check = world.check_surface(body);
    fmt::print(out, "  {}: {}, {}{}\n", world.name(body), counted(check.components.size(), "component"),
               check.is_solid() ? "bounds a solid" : "bounds no solid", check.is_clean() ? "" : "; faults:");
    print_fault(out, "border edges", check.border_edges);
    print_fault(out, "edges of 3 facets or more", check.branching_edges);
    print_fault(out, "turned facets", check.turned_facets);
    print_fault(out, "inside out from", inside_out_of(check));
    print_fault(out, "crossings with itself", check.crossings);
    print_fault(out, "repeated facets", check.repeated_facets);
    print_fault(out, "repeated vertices", check.repeated_vertices);
    print_fault(out, "slivers", check.slivers);
    print_fault(out, "unused vertices", check.unused_vertices);
  }
  fmt::print(out, "\n");
}

}  // namespace tact::scenes

#include "narrowphase/distance/facet_facet.h"

#include <limits>
#include <optional>

#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/distance/segment_facet.h"
#include "narrowphase/distance/vertex_facet.h"

namespace tact::narrowphase {

namespace {

constexpr std::size_t next(std::size_t k) { return (k + 1) % 3; }

std::array<double, 3> on_corner(std::size_t k) {
  std::array<double, 3> weight{};
  weight[k] = 1.0;
  return weight;
}

std::array<double, 3> on_side(std::size_t k, double of_begin, double of_end) {
  std::array<double, 3> weight{};
  weight[k] = of_begin;
  weight[next(k)] = of_end;
  return weight;
}

// Replaces the nearest by that of a corner of `t` and the facet `u`, if it is nearer.
void look_at_corner(const Triangle& t, std::size_t k, const Triangle& u, bool of_first, NearestOfFacets& nearest) {
  Triangle about;
  for (std::size_t i = 0; i < 3; ++i) about[i] = u[i] - t[k];
  const std::array<double, 3> weight = nearest_weights({}, about);
  const Vec3 way = place_of(about, weight);
  const double distance = norm(way);
  if (!(distance < nearest.distance)) return;
  if (of_first) {
    nearest = {on_corner(k), weight, way, distance, 0, static_cast<int>(k)};
  } else {
    nearest = {weight, on_corner(k), -way, distance, 1, static_cast<int>(k)};
  }
}

void look_at_sides(const Triangle& t, std::size_t k, const Triangle& u, std::size_t m, NearestOfFacets& nearest) {
  const EdgeEnds e{t[k], t[next(k)]}, f{u[m], u[next(m)]};
  const std::optional<Nearest> inside = nearest_inside_edges(e, f, nearest.distance);
  if (!inside || !(inside->distance < nearest.distance)) return;
  const Vec3 way = inside->distance * inside->normal;
  nearest = {on_side(k, inside->first[0], inside->first[1]), on_side(m, inside->weight[0], inside->weight[1]),
             dot(way, f.p - e.p) < 0.0 ? -way : way, inside->distance};
}

std::optional<NearestOfFacets> through_side(const Triangle& t, std::size_t k, const Triangle& u, bool of_first,
                                            PredicateCounts& counts) {
  const Segment side{t[k], t[next(k)]};
  if (!segment_triangle_meet(side, u, counts)) return {};
  NearestOfFacets found;
  auto &own = of_first ? found.first : found.second, &other = of_first ? found.second : found.first;
  if (side[0] == side[1]) {
    own = on_corner(k);
    other = weights_about(side[0], u);
    return found;
  }
  const CommonPlace place = first_place(side, u);
  own = on_side(k, 1.0 - place.time, place.time);
  other = place.weight;
  return found;
}

}  // namespace

NearestOfFacets nearest_of_facets(const Triangle& t, const Triangle& u) {
  NearestOfFacets nearest{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < 3; ++k) look_at_corner(t, k, u, true, nearest);
  for (std::size_t k = 0; k < 3; ++k) look_at_corner(u, k, t, false, nearest);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t m = 0; m < 3; ++m) look_at_sides(t, k, u, m, nearest);
  }
  return nearest;
}

NearestOfFacets common_place(const Triangle& t, const Triangle& u) {
  PredicateCounts counts;
  for (const bool of_first : {true, false}) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (const auto found = of_first ? through_side(t, k, u, true, counts) : through_side(u, k, t, false, counts))
        return *found;
    }
  }
  return {on_corner(0), on_corner(0)};
}

}  // namespace tact::narrowphase

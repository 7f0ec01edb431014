#include "narrowphase/distance/closest_places.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/distance/vertex_facet.h"
#include "narrowphase/numeric/double_double.h"

namespace tact::narrowphase {

namespace {

// How far along from `p` to `q`, from 0 to 1, the nearest place to `v` is, and the way to it.
struct PlaceOnEdge {
  double part = 0.0;
  Vec3 way;
};

PlaceOnEdge nearest_on_edge(Vec3 v, Vec3 p, Vec3 q) {
  const Vec3 edge = q - p;
  const double length = norm_squared(edge);
  const double part = length > 0.0 ? std::clamp(dot(v - p, edge) / length, 0.0, 1.0) : 0.0;
  // From the nearer end, so that the product is as short as can be.
  return {part, part < 0.5 ? part * edge - (v - p) : (part - 1.0) * edge - (v - q)};
}

}  // namespace

ClosestPlaces closest_of_vertex_and_facet(Vec3 v, const Triangle& facet) {
  const std::array<double, 3> weights = weights_about(v, facet);
  Vec3 way;
  for (std::size_t k = 0; k < 3; ++k) way = way + weights[k] * (facet[k] - v);
  const double distance = length_of(way);
  return {{1.0, 0.0, 0.0}, weights, distance > 0.0 ? unit_vector(way) : Vec3{}, distance};
}

ClosestPlaces closest_of_edges(const EdgeEnds& e, const EdgeEnds& f, double limit) {
  ClosestPlaces best{.distance = std::numeric_limits<double>::infinity()};
  const auto from_end = [&](bool of_e, bool last) {
    const EdgeEnds &mine = of_e ? e : f, &other = of_e ? f : e;
    const PlaceOnEdge place = nearest_on_edge(last ? mine.q : mine.p, other.p, other.q);
    const double distance = length_of(place.way);
    if (!(distance < best.distance)) return;
    best.distance = distance;
    best.normal = of_e ? place.way : -place.way;
    (of_e ? best.first : best.second) = {last ? 0.0 : 1.0, last ? 1.0 : 0.0, 0.0};
    (of_e ? best.second : best.first) = {1.0 - place.part, place.part, 0.0};
  };
  for (const bool of_e : {true, false}) {
    for (const bool last : {false, true}) from_end(of_e, last);
  }
  const std::optional<Nearest> inside = nearest_inside_edges(e, f, std::min(limit, best.distance));
  if (inside) {
    best.distance = inside->distance;
    best.normal = dot(inside->normal, f.p - e.p) < 0.0 ? -inside->normal : inside->normal;
    best.first = {inside->first[0], inside->first[1], 0.0};
    best.second = {inside->weight[0], inside->weight[1], 0.0};
  } else if (best.distance > 0.0) {
    best.normal = unit_vector(best.normal);
  }
  if (best.distance == 0.0) best.normal = {};
  return best;
}

}  // namespace tact::narrowphase

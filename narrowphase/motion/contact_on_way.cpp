#include "narrowphase/motion/contact_on_way.h"

#include <algorithm>
#include <array>
#include <span>

#include "narrowphase/distance/vertex_facet.h"

namespace tact::narrowphase {

namespace {

// A surface leads nearer that rises by more along its way: what stands across the way but for rounding does not, and so
// a place beside an edge is a contact of the facets on both sides.
constexpr double kRise = 0x1p-20;

// A mesh at a time.
struct AtTime {
  const MovingMesh& mesh;
  double scale, time;

  const Features& features() const { return *mesh.features; }
  Vec3 operator()(int vertex) const {
    const MovingVertex way = mesh.vertex(vertex);
    return scale * (way.at[0] + time * (way.at[1] - way.at[0]));
  }
};

bool leads_nearer(Vec3 along, Vec3 way) {
  const double rise = dot(along, way);
  return rise > 0.0 && rise * rise > kRise * kRise * (norm_squared(along) * norm_squared(way));
}

bool vertex_leads_nearer(const AtTime& at, int vertex, Vec3 way) {
  const Vec3 place = at(vertex);
  return std::ranges::any_of(at.features().neighbors(vertex),
                             [&](int next) { return leads_nearer(at(next) - place, way); });
}

// True if a facet that has the edge leads nearer, straight across it.
bool edge_leads_nearer(const AtTime& at, int edge, Vec3 way) {
  const EdgeVertices ends = at.features().edge(edge);
  const Vec3 p = at(ends[0]), along = at(ends[1]) - p;
  const double length2 = norm_squared(along);
  return std::ranges::any_of(at.features().opposite(edge), [&](int third) {
    const Vec3 to = at(third) - p;
    return leads_nearer(length2 > 0.0 ? to - dot(to, along) / length2 * along : to, way);
  });
}

// Where two edges are nearest inside both, over their lengths; outside 0 and 1 where an end is as near.
std::array<double, 2> places_between(Vec3 p, Vec3 u, Vec3 r, Vec3 w) {
  const double uu = norm_squared(u), ww = norm_squared(w), uw = dot(u, w), square = uu * ww - uw * uw;
  if (!(square > 0.0)) return {-1.0, -1.0};
  const double along_u = dot(u, r - p), along_w = dot(w, r - p);
  return {(along_u * ww - along_w * uw) / square, (along_u * uw - along_w * uu) / square};
}

bool is_inside(double place) { return place > 0.0 && place < 1.0; }

}  // namespace

bool ContactOnWay::of_vertex(const MovingMesh& mesh, double scale, double time, double reach, int vertex, int facet) {
  const AtTime at{mesh, scale, time};
  const Corners& corners = at.features().corners(facet);
  const Vec3 v = at(vertex);
  const Triangle t{at(corners[0]), at(corners[1]), at(corners[2])};
  const std::array<double, 3> weights = nearest_weights(v, t);
  const Vec3 place = place_of(t, weights), way = v - place;
  std::array<int, 3> feature;
  std::size_t count = 0, unused = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k] > 0.0)
      feature[count++] = corners[k];
    else
      unused = k;
  }
  if (count == 1 && vertex_leads_nearer(at, feature[0], way)) return false;
  if (count == 2) {
    const int edge = at.features().facet_edge(facet, static_cast<int>((unused + 1) % 3));
    if (edge < 0 ? vertex_leads_nearer(at, feature[0], way) : edge_leads_nearer(at, edge, way)) return false;
  }
  return !too_near_along(at, at.features(), reach, {{&vertex, 1}, v}, {std::span(feature).first(count), place}, ways_);
}

bool ContactOnWay::of_edges(const MovingMesh& mesh, double scale, double time, double reach, int edge, int other) {
  const AtTime at{mesh, scale, time};
  const EdgeVertices e = at.features().edge(edge), f = at.features().edge(other);
  const Vec3 p = at(e[0]), r = at(f[0]), u = at(e[1]) - p, w = at(f[1]) - r;
  const auto [s, t] = places_between(p, u, r, w);
  if (!is_inside(s) || !is_inside(t)) return false;
  const Vec3 on_e = p + s * u, on_f = r + t * w, way = on_f - on_e;
  if (edge_leads_nearer(at, edge, way) || edge_leads_nearer(at, other, -way)) return false;
  return !too_near_along(at, at.features(), reach, {e, on_e}, {f, on_f}, ways_);
}

}  // namespace tact::narrowphase

#include "narrowphase/motion/opening_walls.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "narrowphase/distance/simplex.h"
#include "narrowphase/motion/moving_way.h"

namespace tact::narrowphase {

namespace {

// Spans that are tried, the longest first: walls open in the first unless facets turn by much in one step.
constexpr int kWallHalvings[] = {0, 4, 10};
constexpr int kMostDirections = 16;  // most are found at once, by the mean
constexpr double kForward = 0.25;    // of the square of a direction's length: it is good enough
constexpr std::size_t kMostWays = 8;

// An edge, or a vertex that has none, which stands at both ends.
struct MovingEdge {
  std::array<MovingVertex, 2> end;
  std::size_t ends = 2;
};
using MovingFacet = std::array<MovingVertex, 3>;

// Ways at one time that a normal has to point along.
class Forward {
 public:
  // False if the way has no direction there.
  bool add(const WayEnds& way, int time) {
    const double length2 = norm_squared(way.at[time]);
    if (!(length2 > kVanishingVolume)) return false;
    unit_[count_++] = normalized(way.at[time]);
    return true;
  }
  // What they are across to `axis`, a unit vector.
  void turn_across(Vec3 axis) {
    for (Vec3& unit : std::span(unit_).first(count_)) {
      unit = unit - dot(unit, axis) * axis;
      if (norm_squared(unit) > kWayRounding) unit = normalized(unit);
    }
  }
  Vec3 direction() const { return common_direction(std::span(unit_).first(count_)); }

 private:
  std::array<Vec3, kMostWays> unit_;
  std::size_t count_ = 0;
};

bool is_before(Vec3 normal, const WayEnds& way, int time) {
  const double sizes = dot(magnitudes(normal), way.size[time]);
  return sizes > kVanishingVolume && dot(normal, way.at[time]) > kWayRounding * sizes;
}

bool is_positive(double volume, double sizes) { return sizes > kVanishingVolume && volume > kWayRounding * sizes; }

double volume_at(const WayEnds& u, int i, Vec3 v, const WayEnds& w, int k) { return dot(w.at[k], cross(u.at[i], v)); }
double sizes_at(const WayEnds& u, int i, Vec3 v, const WayEnds& w, int k) {
  return sum_of_sizes(w.size[k], u.size[i], magnitudes(v));
}

// One end of the edge is at this corner when the step begins.
bool parts_at_corner(const MovingEdge& edge, std::size_t end, const MovingFacet& facet, std::size_t corner,
                     int halvings) {
  const MovingVertex &at = facet[corner], &of_edge = edge.end[end];
  std::array<WayEnds, 4> ways;
  std::size_t count = 0;
  Forward forward;
  const auto add = [&](const MovingVertex& from, const MovingVertex& to) {
    ways[count] = WayEnds({from, to}, halvings);
    return forward.add(ways[count], 0) && forward.add(ways[count++], 1);
  };
  for (std::size_t k = 1; k < 3; ++k) {
    const MovingVertex& other = facet[(corner + k) % 3];
    if (!same(other, at) && !add(at, other)) return false;
  }
  if (edge.ends == 2 && !add(edge.end[1 - end], at)) return false;
  const std::size_t others = count;
  if (!same(of_edge, at)) {
    ways[count] = WayEnds({of_edge, at}, halvings);
    if (!forward.add(ways[count++], 1)) return false;
  }
  const Vec3 normal = forward.direction();
  for (std::size_t i = 0; i < count; ++i) {
    if ((i < others && !is_before(normal, ways[i], 0)) || !is_before(normal, ways[i], 1)) return false;
  }
  return true;
}

// Both ends of the edge are at these corners when the step begins.
bool parts_along_side(const MovingEdge& edge, const MovingFacet& facet, std::array<std::size_t, 2> corners,
                      int halvings) {
  const MovingVertex &from = facet[corners[0]], &to = facet[corners[1]], &third = facet[3 - corners[0] - corners[1]];
  const WayEnds side({from, to}, halvings), inward({from, third}, halvings);
  const bool has_area = !same(third, from) && !same(third, to);
  if (!(norm_squared(side.at[0]) > kVanishingVolume)) return false;
  Forward forward;
  if (has_area && !(forward.add(inward, 0) && forward.add(inward, 1))) return false;
  std::array<WayEnds, 2> leaving{WayEnds({edge.end[0], from}, halvings), WayEnds({edge.end[1], to}, halvings)};
  const std::array<bool, 2> stays{same(edge.end[0], from), same(edge.end[1], to)};
  for (std::size_t i = 0; i < 2; ++i) {
    if (!stays[i] && !forward.add(leaving[i], 1)) return false;
  }
  if (!has_area && stays[0] && stays[1]) return true;
  const Vec3 axis = normalized(side.at[0]);
  forward.turn_across(axis);
  const Vec3 along = cross(forward.direction(), axis);
  for (std::size_t i = 0; i < 2; ++i) {
    for (int time = 0; time < 2 && !stays[i]; ++time) {
      if (!is_positive(volume_at(side, time, along, leaving[i], 1), sizes_at(side, time, along, leaving[i], 1)))
        return false;
    }
  }
  if (!has_area) return true;
  const auto of_inward = [&](const auto& f, int i, int k) { return f(side, i, along, inward, k); };
  return is_positive(of_inward(volume_at, 0, 0), of_inward(sizes_at, 0, 0)) &&
         is_positive(of_inward(volume_at, 1, 1), of_inward(sizes_at, 1, 1)) &&
         is_positive(of_inward(volume_at, 0, 1) + of_inward(volume_at, 1, 0),
                     of_inward(sizes_at, 0, 1) + of_inward(sizes_at, 1, 0));
}

// Whether an edge and a facet that share a point at time 0 meet from then on at most in vertices that stay together.
bool parts(const MovingEdge& edge, const MovingFacet& facet, int halvings) {
  constexpr std::size_t kNone = 3;
  std::array<std::size_t, 2> corners{kNone, kNone};
  for (std::size_t i = 0; i < edge.ends; ++i) {
    for (std::size_t k = 3; k-- > 0;) {
      if (edge.end[i].at[0] == facet[k].at[0]) corners[i] = k;
    }
  }
  if (corners[0] == kNone && corners[1] == kNone) return false;
  if (corners[0] == kNone) return parts_at_corner(edge, 1, facet, corners[1], halvings);
  if (corners[1] == kNone) return parts_at_corner(edge, 0, facet, corners[0], halvings);
  return corners[0] != corners[1] && parts_along_side(edge, facet, corners, halvings);
}

MovingFacet moving_facet(const MovingMesh& mesh, const Corners& c) {
  return {mesh.vertex(c[0]), mesh.vertex(c[1]), mesh.vertex(c[2])};
}

MovingEdge moving_edge(const MovingMesh& mesh, EdgeVertices e) { return {{mesh.vertex(e[0]), mesh.vertex(e[1])}}; }

// Of all edges at the vertex.
bool vertex_parts(const MovingMesh& of_vertex, int vertex, const MovingMesh& of_facet, int facet, int halvings) {
  const MovingFacet corners = moving_facet(of_facet, of_facet.features->corners(facet));
  const std::span<const int> neighbors = of_vertex.features->neighbors(vertex);
  if (neighbors.empty()) return parts({{of_vertex.vertex(vertex), {}}, 1}, corners, halvings);
  return std::ranges::all_of(neighbors, [&](int next) {
    return parts(moving_edge(of_vertex, {vertex, next}), corners, halvings);
  });
}

// Of an edge from all facets that have the other.
bool edge_parts(const MovingMesh& of_edge, int edge, const MovingMesh& of_other, int other, int halvings) {
  const MovingEdge moving = moving_edge(of_edge, of_edge.features->edge(edge));
  const EdgeVertices ends = of_other.features->edge(other);
  return std::ranges::all_of(of_other.features->opposite(other), [&](int third) {
    return parts(moving, moving_facet(of_other, {ends[0], ends[1], third}), halvings);
  });
}

bool share_a_place(const MovingMesh& a, std::span<const int> ones, const MovingMesh& b, std::span<const int> others) {
  return std::ranges::any_of(
      ones, [&](int v) { return std::ranges::any_of(others, [&](int w) { return a.begin_of(v) == b.begin_of(w); }); });
}

}  // namespace

Vec3 common_direction(std::span<const Vec3> units) {
  if (units.empty()) return {};
  Vec3 direction;
  for (const Vec3& unit : units) direction = direction + unit;
  direction = (1.0 / static_cast<double>(units.size())) * direction;
  SimplexPoints simplex;
  for (int step = 0; step < kMostDirections; ++step) {
    const Vec3 last = *std::ranges::min_element(units, {}, [&](const Vec3& unit) { return dot(direction, unit); });
    if (dot(direction, last) > kForward * norm_squared(direction)) return direction;
    simplex.point[static_cast<std::size_t>(simplex.count++)] = last;
    const SimplexClosest nearest = simplex_closest(simplex);
    if (nearest.carrier_count == 4) break;
    direction = nearest.point;
    simplex.count = nearest.carrier_count;
    const SimplexPoints all = simplex;
    for (std::size_t i = 0; i < static_cast<std::size_t>(simplex.count); ++i)
      simplex.point[i] = all.point[static_cast<std::size_t>(nearest.carrier[i])];
  }
  return {};
}

double walls_open_until(const MovingMesh& a, const MovingMesh& b, FeaturePair kind, int feature_a, int feature_b) {
  const bool are_edges = kind == FeaturePair::edge_edge, vertex_is_a = kind == FeaturePair::vertex_facet;
  const MovingMesh &of_vertex = vertex_is_a ? a : b, &of_facet = vertex_is_a ? b : a;
  const int vertex = vertex_is_a ? feature_a : feature_b, facet = vertex_is_a ? feature_b : feature_a;
  if (are_edges ? !share_a_place(a, a.features->edge(feature_a), b, b.features->edge(feature_b))
                : !share_a_place(of_vertex, {&vertex, 1}, of_facet, of_facet.features->corners(facet)))
    return 0.0;
  for (const int halvings : kWallHalvings) {
    const bool open =
        are_edges ? edge_parts(a, feature_a, b, feature_b, halvings) && edge_parts(b, feature_b, a, feature_a, halvings)
                  : vertex_parts(of_vertex, vertex, of_facet, facet, halvings);
    if (open) return std::ldexp(1.0, -halvings);
  }
  return 0.0;
}

}  // namespace tact::narrowphase

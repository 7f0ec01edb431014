#include "scenes/dynamics/penetration.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tact::scenes {
namespace {

constexpr int kUnknown = -1;
constexpr int kOutside = -2;

Vec3 position(const SeenBody& body, int vertex) { return body.positions[static_cast<std::size_t>(vertex)]; }

Vec3 facet_normal(const SeenBody& body, int facet) {
  const Vec3 a = position(body, body.body.facets(0, facet));
  return cross(position(body, body.body.facets(1, facet)) - a, position(body, body.body.facets(2, facet)) - a);
}

// The mean normal of the facets at an edge, not of unit length.
Vec3 edge_normal(const SeenBody& body, const Edge& edge) {
  const Vec3 normal = facet_normal(body, edge.facet);
  return edge.other_facet < 0 ? normal : normal + facet_normal(body, edge.other_facet);
}

// Near points count more. No distance is so small that its inverse overflows the sums.
double weight_at(Vec3 from, Vec3 to) { return 1.0 / std::max(norm_squared(to - from), 1e-18); }

const Edge& edge_at(const SeenBody& body, int edge) {
  return body.body.topology.edges()[static_cast<std::size_t>(edge)];
}

double line_distance_squared(Vec3 point, Vec3 on_line, Vec3 direction) {
  return norm_squared(cross(point - on_line, direction));
}

// The vertex near `vertex` that is nearest to the line: each step goes to the best neighbour.
int walk_to_line(const SeenBody& body, int vertex, Vec3 on_line, Vec3 direction) {
  double nearest = line_distance_squared(position(body, vertex), on_line, direction);
  for (int from = -1; from != vertex;) {
    from = vertex;
    for (const Neighbor& neighbor : body.body.topology.neighbors(from)) {
      const double distance = line_distance_squared(position(body, neighbor.vertex), on_line, direction);
      if (distance < nearest) nearest = distance, vertex = neighbor.vertex;
    }
  }
  return vertex;
}

struct LineHit {
  double distance = 0.0;
  std::array<double, 3> weights{};
};

// Where the line leaves the body through the facet, ahead of its start.
std::optional<LineHit> way_out(const SeenBody& body, int facet, Vec3 on_line, Vec3 direction) {
  const Vec3 a = position(body, body.body.facets(0, facet)) - on_line;
  const Vec3 b = position(body, body.body.facets(1, facet)) - on_line;
  const Vec3 c = position(body, body.body.facets(2, facet)) - on_line;
  const double u = dot(direction, cross(b, c));
  const double v = dot(direction, cross(c, a));
  const double w = dot(direction, cross(a, b));
  const bool leaves = u >= 0.0 && v >= 0.0 && w >= 0.0;
  if (!leaves && !(body.body.surface == Surface::sheet && u <= 0.0 && v <= 0.0 && w <= 0.0)) return std::nullopt;
  const double sum = u + v + w;
  if (sum == 0.0) return std::nullopt;
  const double distance = (u * dot(a, direction) + v * dot(b, direction) + w * dot(c, direction)) / sum;
  if (!(distance > 0.0)) return std::nullopt;
  return LineHit{distance, {u / sum, v / sum, w / sum}};
}

}  // namespace

void PenetrationFinder::find(const Contact& contact, bool x_is_a, const SeenBody& x, const SeenBody& y,
                             std::vector<SurfacePoint>& points) {
  state_.resize(std::max(state_.size(), x.positions.size()), kUnknown);
  visited_.clear();
  entries_.clear();
  found_.clear();
  find_crossings(contact, x_is_a, x, y);
  if (y.body.surface == Surface::closed) {
    enter_closed(x, y, points);
  } else {
    turn_sheet_normals(contact, x_is_a, x);
    enter_sheet(x);
  }
  start_inside(x, y);
  if (y.body.surface == Surface::closed) spread_inside(x, y);
  for (const Inside& inside : found_) {
    if (inside.place.depth > 0.0) points.push_back(contact_point(y, inside.vertex, inside.normal, inside.place));
  }
  for (SurfacePoint& point : points) point.depth = std::min(point.depth, contact.depth);
  for (const int vertex : visited_) state_[static_cast<std::size_t>(vertex)] = kUnknown;
}

// Every facet with an edge that crosses a facet of y meets that facet. As the report holds every pair that meets, it is
// enough to test an edge where its lowest facet comes up, and none is tested twice.
void PenetrationFinder::find_crossings(const Contact& contact, bool x_is_a, const SeenBody& x, const SeenBody& y) {
  crossings_.clear();
  for (const FacetPair& pair : contact.facet_pairs()) {
    const int facet = x_is_a ? pair.a : pair.b;
    for (int corner = 0; corner < 3; ++corner) {
      const int edge = x.body.topology.edge_of(facet, corner);
      if (edge_at(x, edge).facet == facet) add_crossing(edge, x_is_a ? pair.b : pair.a, x, y);
    }
  }
  std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& i, const Crossing& j) {
    return i.edge != j.edge ? i.edge < j.edge : i.t != j.t ? i.t < j.t : i.facet < j.facet;
  });
}

// The three volumes between the edge and those of the facet have exactly opposite signs for the two facets of an edge
// of y, as they are made of the same products: an edge of x that passes there crosses at least one of both.
void PenetrationFinder::add_crossing(int edge, int facet, const SeenBody& x, const SeenBody& y) {
  const Vec3 p = position(x, edge_at(x, edge).from);
  const Vec3 q = position(x, edge_at(x, edge).to);
  const Vec3 a = position(y, y.body.facets(0, facet));
  const Vec3 b = position(y, y.body.facets(1, facet));
  const Vec3 c = position(y, y.body.facets(2, facet));
  const Vec3 normal = cross(b - a, c - a);
  const double side_p = dot(normal, p - a);
  const double side_q = dot(normal, q - a);
  if ((side_p < 0.0) == (side_q < 0.0)) return;
  const Vec3 along = q - p;
  const double u = dot(along, cross(b - p, c - p));
  const double v = dot(along, cross(c - p, a - p));
  const double w = dot(along, cross(a - p, b - p));
  if (!((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0))) return;
  const double sum = u + v + w;
  const double length = norm(normal);
  if (sum == 0.0 || !(length > 0.0)) return;
  const double t = side_p / (side_p - side_q);
  crossings_.push_back({edge, t, facet, {u / sum, v / sum, w / sum}, p + t * along, (1.0 / length) * normal});
}

void PenetrationFinder::turn_sheet_normals(const Contact& contact, bool x_is_a, const SeenBody& x) {
  constexpr double kDecisive = 0.3;  // cosine between both normals from which that of a closed x tells the side
  const Vec3 direction{contact.direction.x(), contact.direction.y(), contact.direction.z()};
  for (Crossing& crossing : crossings_) {
    double side = dot(crossing.normal, x_is_a ? -direction : direction);
    if (x.body.surface == Surface::closed) {
      const Vec3 outwards = edge_normal(x, edge_at(x, crossing.edge));
      const double cosine = dot(crossing.normal, outwards) / std::max(norm(outwards), 1e-300);
      if (std::abs(cosine) > kDecisive) side = -cosine;
    }
    if (side < 0.0) crossing.normal = -crossing.normal;
  }
}

// The crossings of the edge, as a range of crossings_.
std::pair<int, int> PenetrationFinder::crossings_of(int edge) const {
  const auto range = std::equal_range(crossings_.begin(), crossings_.end(), Crossing{.edge = edge},
                                      [](const Crossing& i, const Crossing& j) { return i.edge < j.edge; });
  return {static_cast<int>(range.first - crossings_.begin()), static_cast<int>(range.second - crossings_.begin())};
}

// Where the line from `p` along `normal` leaves y, near a place that is known; nothing if it does not leave there.
std::optional<PenetrationFinder::Place> PenetrationFinder::locate(const SeenBody& y, Vec3 p, Vec3 normal,
                                                                  const Place& near) {
  int start = y.body.facets(0, near.facet);
  for (int k = 1; k < 3; ++k) {
    const int other = y.body.facets(k, near.facet);
    if (line_distance_squared(position(y, other), p, normal) < line_distance_squared(position(y, start), p, normal)) {
      start = other;
    }
  }
  const int vertex = walk_to_line(y, start, p, normal);
  for (const Neighbor& neighbor : y.body.topology.neighbors(vertex)) {
    const Edge& edge = edge_at(y, neighbor.edge);
    for (const int facet : {edge.facet, edge.other_facet}) {
      if (facet < 0) continue;
      if (const auto hit = way_out(y, facet, p, normal)) {
        return Place{facet, hit->weights, std::min(hit->distance, near.depth)};
      }
    }
  }
  return std::nullopt;
}

// An end of an edge is inside if the edge leaves y at the crossing that is nearest to it.
void PenetrationFinder::enter_closed(const SeenBody& x, const SeenBody& y, std::vector<SurfacePoint>& points) {
  for (std::size_t first = 0; first < crossings_.size();) {
    const Edge& edge = edge_at(x, crossings_[first].edge);
    std::size_t last = first;
    while (last + 1 < crossings_.size() && crossings_[last + 1].edge == crossings_[first].edge) ++last;
    const Vec3 along = position(x, edge.to) - position(x, edge.from);
    const bool from_inside = dot(crossings_[first].normal, along) > 0.0;
    const bool to_inside = dot(crossings_[last].normal, along) < 0.0;
    if (from_inside) entries_.push_back({edge.from, static_cast<int>(first)});
    if (to_inside) entries_.push_back({edge.to, static_cast<int>(last)});
    if (!from_inside && !to_inside && first != last) {
      add_edge_middle(x, y, crossings_[first], crossings_[last], points);
    }
    first = last + 1;
  }
}

void PenetrationFinder::add_edge_middle(const SeenBody& x, const SeenBody& y, const Crossing& enter,
                                        const Crossing& leave, std::vector<SurfacePoint>& points) {
  const Vec3 out = enter.normal + leave.normal;
  const double length = norm(out);
  if (!(length > 0.0)) return;
  const Vec3 normal = (1.0 / length) * out;
  const Vec3 middle = 0.5 * enter.point + 0.5 * leave.point;
  const Place near{enter.facet, enter.weights, norm(enter.point - middle)};
  const Place place = locate(y, middle, normal, near).value_or(near);
  const double t = 0.5 * (enter.t + leave.t);
  const Edge& edge = edge_at(x, enter.edge);
  SurfacePoint point = contact_point(y, edge.from, normal, place);
  point.x_vertices[1] = edge.to;
  point.x_weights = {1.0 - t, t};
  points.push_back(point);
}

void PenetrationFinder::enter_sheet(const SeenBody& x) {
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    const Edge& edge = edge_at(x, crossings_[i].edge);
    const auto [first, last] = crossings_of(crossings_[i].edge);
    if (last - first != 1) continue;
    const Vec3 along = position(x, edge.to) - position(x, edge.from);
    entries_.push_back({dot(crossings_[i].normal, along) > 0.0 ? edge.from : edge.to, static_cast<int>(i)});
  }
}

// The first ring: vertices at edges that cross.
void PenetrationFinder::start_inside(const SeenBody& x, const SeenBody& y) {
  std::sort(entries_.begin(), entries_.end(), [](const Entry& i, const Entry& j) {
    return i.vertex != j.vertex ? i.vertex < j.vertex : i.crossing < j.crossing;
  });
  ring_.clear();
  for (std::size_t i = 0; i < entries_.size();) {
    const int vertex = entries_[i].vertex;
    const Vec3 p = position(x, vertex);
    Vec3 normal;
    Place near{.depth = std::numeric_limits<double>::infinity()};
    for (; i < entries_.size() && entries_[i].vertex == vertex; ++i) {
      const Crossing& crossing = crossings_[static_cast<std::size_t>(entries_[i].crossing)];
      normal = normal + weight_at(p, crossing.point) * crossing.normal;
      const double distance = norm(crossing.point - p);
      if (distance < near.depth) near = {crossing.facet, crossing.weights, distance};
    }
    const double length = norm(normal);
    if (!(length > 0.0)) continue;
    normal = (1.0 / length) * normal;
    const Place plane{near.facet, near.weights, std::min(near.depth, dot(point_at(y, near) - p, normal))};
    add_inside({vertex, normal, locate(y, p, normal, near).value_or(plane)});
  }
}

void PenetrationFinder::add_inside(const Inside& inside) {
  const bool in = inside.place.depth > 0.0;
  state_[static_cast<std::size_t>(inside.vertex)] = in ? static_cast<int>(found_.size()) : kOutside;
  visited_.push_back(inside.vertex);
  if (!in) return;
  ring_.push_back(inside.vertex);
  found_.push_back(inside);
}

// Ring by ring inwards. A ring takes only from those before it, so that its order does not matter.
void PenetrationFinder::spread_inside(const SeenBody& x, const SeenBody& y) {
  while (!ring_.empty()) {
    next_ring_.clear();
    for (const int vertex : ring_) {
      for (const Neighbor& neighbor : x.body.topology.neighbors(vertex)) {
        if (state_[static_cast<std::size_t>(neighbor.vertex)] != kUnknown) continue;
        const auto [first, last] = crossings_of(neighbor.edge);
        if (first == last) next_ring_.push_back(neighbor.vertex);
      }
    }
    std::sort(next_ring_.begin(), next_ring_.end());
    next_ring_.erase(std::unique(next_ring_.begin(), next_ring_.end()), next_ring_.end());
    const int known = static_cast<int>(found_.size());
    ring_.clear();
    for (const int vertex : next_ring_) add_inside(from_neighbors(x, y, vertex, known));
  }
}

PenetrationFinder::Inside PenetrationFinder::from_neighbors(const SeenBody& x, const SeenBody& y, int vertex,
                                                            int known) const {
  const Vec3 p = position(x, vertex);
  Vec3 normal;
  Place near{.depth = std::numeric_limits<double>::infinity()};
  for (const Neighbor& neighbor : x.body.topology.neighbors(vertex)) {
    const int place = state_[static_cast<std::size_t>(neighbor.vertex)];
    if (place < 0 || place >= known) continue;
    const Inside& other = found_[static_cast<std::size_t>(place)];
    normal = normal + weight_at(p, position(x, neighbor.vertex)) * other.normal;
    const double way = other.place.depth + norm(position(x, neighbor.vertex) - p);
    if (way < near.depth) near = {other.place.facet, other.place.weights, way};
  }
  const double length = norm(normal);
  if (!(length > 0.0)) return {.vertex = vertex};
  normal = (1.0 / length) * normal;
  return {vertex, normal, locate(y, p, normal, near).value_or(Place{})};
}

SurfacePoint PenetrationFinder::contact_point(const SeenBody& y, int vertex, Vec3 normal, const Place& place) {
  SurfacePoint point;
  point.x_vertices = {vertex, vertex};
  point.x_weights = {1.0, 0.0};
  for (int k = 0; k < 3; ++k) point.y_vertices[static_cast<std::size_t>(k)] = y.body.facets(k, place.facet);
  point.y_weights = place.weights;
  point.normal = normal;
  point.depth = place.depth;
  return point;
}

Vec3 PenetrationFinder::point_at(const SeenBody& y, const Place& place) {
  return place.weights[0] * position(y, y.body.facets(0, place.facet)) +
         place.weights[1] * position(y, y.body.facets(1, place.facet)) +
         place.weights[2] * position(y, y.body.facets(2, place.facet));
}

}  // namespace tact::scenes

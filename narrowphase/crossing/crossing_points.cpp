#include "narrowphase/crossing/crossing_points.h"

#include <algorithm>
#include <tuple>

#include "narrowphase/contact_points/touching_normal.h"
#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/queries/mesh_queries.h"

namespace tact::narrowphase {

namespace {

double negative(double distance) { return distance > 0.0 ? -distance : 0.0; }

// How far apart edges that have passed each other may be. Of one mesh the last step may tell of more than `within`.
double farthest_edges(const Crossing& c) { return c.of_itself ? kAnywhere : c.within; }

// Calls visit(hit) for those hits of an edge whose facet has the other edge.
template <class Visit>
void for_each_hit_beside(const CrossedSurface& own, int edge, const CrossedSurface& other, int other_edge,
                         const Visit& visit) {
  const EdgeVertices ends = other.mesh.features->edge(other_edge);
  for (const EdgeHit& hit : own.cut.hits_of(own.source_ends(edge))) {
    const Corners& corners = other.mesh.features->corners(other.mesh.mesh->facet_of_source(hit.facet));
    if (std::ranges::all_of(ends, [&](int v) { return std::ranges::find(corners, v) != corners.end(); })) visit(hit);
  }
}

// Whether one of two edges meets a facet that has the other one.
bool meet_beside(const Crossing& c, int edge_a, int edge_b) {
  bool any = false;
  const auto found = [&](const EdgeHit&) { any = true; };
  for_each_hit_beside(c.a(), edge_a, c.b(), edge_b, found);
  if (!any) for_each_hit_beside(c.b(), edge_b, c.a(), edge_a, found);
  return any;
}

// Whether a point of an edge is inside a closed body.
bool is_inside(const CrossedSurface& own, int edge, const std::array<double, 3>& weight, const CrossedSurface& body) {
  if (body.surface != SurfaceKind::closed) return false;
  const EdgeVertices ends = own.mesh.features->edge(edge);
  return contains(*body.mesh.mesh,
                  weight[0] * own.mesh.mesh->position(ends[0]) + weight[1] * own.mesh.mesh->position(ends[1]));
}

// Of two bodies: whether an edge is past the other one, with both ends and cut by nothing between, or with a point
// where it is cut.
bool is_past_body(const CrossedSurface& own, int edge, const std::array<double, 3>& weight,
                  const CrossedSurface& body) {
  const EdgeVertices ends = own.source_ends(edge);
  if (!own.cut.is_cut(ends)) return own.cut.is_past(ends[0]) && own.cut.is_past(ends[1]);
  return is_inside(own, edge, weight, body);
}

// Of one mesh: whether a point of an edge is on a piece that is past the mesh. `place` is 0 at the edge's first end and
// 1 at its second.
bool is_on_piece_past(const CrossedSurface& own, int edge, double place) {
  const ScaledMesh mesh = own.scaled();
  const EdgeVertices ends = own.source_ends(edge);
  double first = 1.0, last = 0.0;  // where it meets something
  for (const EdgeHit& hit : own.cut.hits_of(ends)) {
    const Triangle t = mesh.triangle(mesh.mesh.facet_of_source(hit.facet));
    const auto [p, q] = heights_of_ends(mesh, hit, cross(t[1] - t[0], t[2] - t[0]));
    const double at = p != q ? p / (p - q) : 0.5;
    first = std::min(first, at);
    last = std::max(last, at);
  }
  return (own.exits.find(ends[0]) != nullptr && place < first) || (own.exits.find(ends[1]) != nullptr && place > last);
}

bool is_past_own_mesh(const CrossedSurface& own, int edge, double place, Vec3 normal) {
  return is_on_piece_past(own, edge, place) && dot(own.exits_of(edge), normal) >= 0.0;
}

bool have_passed(const Crossing& c, const FeaturePoint& near) {
  const int a = near.edge_a, b = near.edge_b;
  if (c.of_itself) {
    return is_past_own_mesh(c.a(), a, near.weight_a[1], near.normal) ||
           is_past_own_mesh(c.b(), b, near.weight_b[1], -near.normal);
  }
  return is_past_body(c.a(), a, near.weight_a, c.b()) || is_past_body(c.b(), b, near.weight_b, c.a());
}

// From the edge of a to that of b, as they lay before.
Vec3 facing_of_edges(const Crossing& c, int edge_a, int edge_b) {
  Vec3 sum = c.b().exits_of(edge_b) - c.a().exits_of(edge_a);
  if (c.of_itself && sum == Vec3{}) {
    for_each_hit_beside(c.a(), edge_a, c.b(), edge_b, [&](const EdgeHit& hit) { sum = sum - c.side_of(hit); });
    for_each_hit_beside(c.b(), edge_b, c.a(), edge_a, [&](const EdgeHit& hit) { sum = sum + c.side_of(hit); });
  }
  const double length = norm(sum);
  if (length > 0.0) return (1.0 / length) * sum;
  const Vec3 kept = c.a().kept_by(c.a().source_ends(edge_a)[0]);
  return kept != Vec3{} ? kept : c.direction;
}

// Of one mesh: whether edges that have passed each other are two parts of it.
bool are_of_two_parts(const Crossing& c, int edge_a, int edge_b, const Nearest& nearest, SurfaceWays& ways) {
  if (nearest.distance <= kTouches) return false;
  const ScaledMesh m = c.a().scaled();
  const EdgeVertices source_a = c.a().source_ends(edge_a), source_b = c.a().source_ends(edge_b);
  if (nearest.distance > c.within && !(dot(c.sides.last_points().side(source_b, source_a), nearest.normal) > 0.0))
    return false;
  const EdgeVertices e = m.features.edge(edge_a), f = m.features.edge(edge_b);
  const EdgeEnds at_e = m.ends(edge_a);
  const Vec3 on_e = nearest.first[0] * at_e.p + nearest.first[1] * at_e.q;
  return !too_near_along(m, c.reach, {e, on_e}, {f, on_e - nearest.distance * nearest.normal}, ways);
}

std::optional<FeaturePoint> point_of_passed_edges(const Crossing& c, int edge_a, int edge_b, SurfaceWays& ways) {
  const ScaledMesh a = c.a().scaled(), b = c.b().scaled();
  const auto nearest = nearest_between_edges(a.ends(edge_a), a.beside(edge_a), b.ends(edge_b), b.beside(edge_b),
                                             farthest_edges(c), EdgeSide::passed);
  if (!nearest || dot(nearest->normal, facing_of_edges(c, edge_a, edge_b)) <= kFaces) return {};
  if (c.of_itself && !are_of_two_parts(c, edge_a, edge_b, *nearest, ways)) return {};
  FeaturePoint point = point_of_edges(*nearest, a, edge_a, b, edge_b, negative(nearest->distance / a.scale));
  if (c.of_itself) point.normal = point.normal + Vec3{};  // as of edges that have not passed each other
  return point;
}

// The points of ways, from `ways` on, take the place of what is near between the same features. Of two ways' the deeper
// one stays.
void take_places_of_near(std::size_t ways, std::vector<FeaturePoint>& found) {
  const auto begin = found.begin() + static_cast<std::ptrdiff_t>(ways);
  const auto by_features = [](const FeaturePoint& x, const FeaturePoint& y) { return x.features() < y.features(); };
  std::sort(begin, found.end(), [&](const FeaturePoint& x, const FeaturePoint& y) {
    const auto order = [](const FeaturePoint& p) {
      return std::tuple_cat(p.features(), std::tie(p.gap, p.normal.x, p.normal.y, p.normal.z));
    };
    return order(x) < order(y);
  });
  const auto end = std::unique(
      begin, found.end(), [](const FeaturePoint& x, const FeaturePoint& y) { return x.features() == y.features(); });
  const auto kept = std::remove_if(found.begin(), begin, [&](const FeaturePoint& near) {
    return std::binary_search(begin, end, near, by_features);
  });
  found.erase(end, found.end());
  found.erase(kept, begin);
}

void append_vertices(const Crossing& c, const CrossedSurface& own, const CrossedSurface& other,
                     std::vector<FeaturePoint>& found) {
  const FeaturePair kind = &own == &c.a() ? FeaturePair::vertex_facet : FeaturePair::facet_vertex;
  for (std::size_t i = 0; i < own.exits.values().size(); ++i) {
    const NearestExit& exit = own.exits.values()[i];
    const int vertex = own.mesh.features->vertex_of_source(own.exits.vertices()[i]);
    Vec3 out = exit.direction;
    if (exit.distance == 0.0 && !c.of_itself && other.surface == SurfaceKind::closed) {
      const Vec3 along = &own == &c.a() ? -c.direction : c.direction;
      out = touching_normal(other.scaled(), exit.place.used(), along, Turned::as_it_is);
    }
    found.push_back(point_of_vertex(kind, *own.mesh.mesh, vertex, *other.mesh.mesh, exit.place, -out,
                                    negative(exit.distance / own.scale)));
  }
}

}  // namespace

bool leads_back(const Crossing& c, int source_vertex, Vec3 normal) {
  const NearestExit* exit = c.a().exits.find(source_vertex);
  return exit != nullptr && dot(normal, exit->direction) >= 0.0;
}

std::optional<FeaturePoint> point_of_near_edges(const Crossing& c, const FeaturePoint& near, SurfaceWays& ways) {
  if (c.of_itself && c.a().scale * near.gap <= kTouches) return near;
  if (meet_beside(c, near.edge_a, near.edge_b)) return {};  // append() makes it
  if (!have_passed(c, near)) return near;
  return point_of_passed_edges(c, near.edge_a, near.edge_b, ways);
}

void CrossingPoints::append(const Crossing& c, std::vector<FeaturePoint>& found) {
  append_edges(c, found);
  if (!c.of_itself) {
    append_edges_through(c, c.a(), c.b(), found);
    append_edges_through(c, c.b(), c.a(), found);
    append_vertices(c, c.b(), c.a(), found);
  }
  append_vertices(c, c.a(), c.b(), found);
  if (!c.of_itself) append_ways_apart(c, found);
}

void CrossingPoints::append_ways_apart(const Crossing& c, std::vector<FeaturePoint>& found) {
  if (c.groups == nullptr) groups_.find(c);
  const CrossingGroups& groups = c.groups == nullptr ? groups_ : *c.groups;
  has_point_.assign(static_cast<std::size_t>(groups.count()), 0);
  for (const FeaturePoint& point : found) {
    const int group = point.gap <= 0.0 ? groups.group_of(point) : -1;
    if (group >= 0) has_point_[group] = 1;
  }
  if (std::ranges::find(has_point_, 0) == has_point_.end()) return;
  kept_.find(c, groups);
  const ScaledMesh a = c.a().scaled(), b = c.b().scaled();
  const std::size_t before = found.size();
  for (int group = 0; group < groups.count(); ++group) {
    if (has_point_[group] != 0) continue;
    groups.take_parts(group, part_a_, part_b_);
    way_apart_.append_points({.a = a,
                              .b = b,
                              .part_a = part_a_,
                              .part_b = part_b_,
                              .came = kept_.came(group),
                              .direction = c.direction,
                              .depth = c.within},
                             found);
  }
  take_places_of_near(before, found);
}

// Calls visit(edges) for two edges that have passed each other and may have a point, or for some that came before.
template <class Visit>
void CrossingPoints::filter(const Crossing& c, EdgePair edges, const Visit& visit) {
  waiting_.add(c.a().scaled(), edges.first, c.b().scaled(), edges.second, farthest_edges(c), EdgeSide::passed, visit);
}

// Calls visit(edges) for the others that came before.
template <class Visit>
void CrossingPoints::filter_rest(const Crossing& c, const Visit& visit) {
  waiting_.visit_all(c.a().scaled(), c.b().scaled(), farthest_edges(c), EdgeSide::passed, visit);
}

// Edges that meet facets, and those of the facets that they meet.
void CrossingPoints::append_edges(const Crossing& c, std::vector<FeaturePoint>& found) {
  candidates_.clear();
  const auto keep = [&](int edge_a, int edge_b) { candidates_.emplace_back(edge_a, edge_b); };
  const auto take = [&](const CrossedSurface& own, const CrossedSurface& other) {
    for (const EdgeHit& hit : own.cut.hits()) {
      const int facet = other.mesh.mesh->facet_of_source(hit.facet);
      for (int k = 0; k < 3; ++k) {
        const int edge = other.mesh.features->facet_edge(facet, k);
        if (edge < 0) continue;
        if (c.of_itself && share_a_vertex(own.mesh.features->edge(hit.edge), other.mesh.features->edge(edge))) continue;
        // Of one mesh the edge with the lesser vertices is a's.
        const bool is_a = c.of_itself ? own.source_ends(hit.edge) < own.source_ends(edge) : &own == &c.a();
        filter(c, is_a ? EdgePair(hit.edge, edge) : EdgePair(edge, hit.edge), keep);
      }
    }
  };
  take(c.a(), c.b());
  if (!c.of_itself) take(c.b(), c.a());
  filter_rest(c, keep);
  std::ranges::sort(candidates_);
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  for (const auto& [edge_a, edge_b] : candidates_) {
    if (const auto point = point_of_passed_edges(c, edge_a, edge_b, ways_)) found.push_back(*point);
  }
}

void CrossingPoints::append_edges_through(const Crossing& c, const CrossedSurface& own, const CrossedSurface& body,
                                          std::vector<FeaturePoint>& found) {
  if (body.surface != SurfaceKind::closed) return;
  with_point_.clear();
  touching_.clear();
  for (const FeaturePoint& point : found) {
    if (point.kind != FeaturePair::edge_edge) continue;
    if (point.gap < 0.0) with_point_.push_back(&own == &c.a() ? point.edge_a : point.edge_b);
    if (point.gap == 0.0) touching_.emplace_back(point.edge_a, point.edge_b);
  }
  std::ranges::sort(with_point_);
  std::ranges::sort(touching_);
  const auto hits = own.cut.hits();
  for (std::size_t i = 0, end = 0; i < hits.size(); i = end) {
    for (end = i + 1; end < hits.size() && hits[end].edge == hits[i].edge;) ++end;
    if (end == i + 1 || std::ranges::binary_search(with_point_, hits[i].edge)) continue;
    if (own.cut.is_past(hits[i].vertices[0]) || own.cut.is_past(hits[i].vertices[1])) continue;
    const auto point = point_through(c, own, hits.subspan(i, end - i), body);
    if (point && !std::ranges::binary_search(touching_, EdgePair(point->edge_a, point->edge_b)))
      found.push_back(*point);
  }
}

std::optional<FeaturePoint> CrossingPoints::point_through(const Crossing& c, const CrossedSurface& own,
                                                          std::span<const EdgeHit> hits, const CrossedSurface& body) {
  const int edge = hits[0].edge;
  const bool of_a = &own == &c.a();
  const ScaledMesh surface = body.scaled();
  EdgeThrough through(own.scaled().ends(edge));
  for (const EdgeHit& hit : hits) through.add_hit(surface.triangle(surface.mesh.facet_of_source(hit.facet)));
  std::optional<FeaturePoint> best;
  const auto look_at = [&](int edge_a, int edge_b) {
    const auto point = point_of_passed_edges(c, edge_a, edge_b, ways_);
    if (!point) return;
    const bool better =
        !best || point->gap > best->gap || (point->gap == best->gap && point->features() < best->features());
    if (better && is_inside(own, edge, of_a ? point->weight_a : point->weight_b, body)) best = point;
  };
  for (const int f : beside_.find(through, surface, c.within))
    filter(c, of_a ? EdgePair(edge, f) : EdgePair(f, edge), look_at);
  filter_rest(c, look_at);
  return best;
}

}  // namespace tact::narrowphase

#include "narrowphase/contact_points/point_finder.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/base/lowest_bits.h"
#include "narrowphase/contact_points/own_inside.h"
#include "narrowphase/contact_points/touching_normal.h"
#include "narrowphase/crossing/crossing_points.h"
#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/distance/facet_border.h"
#include "narrowphase/distance/signs.h"
#include "narrowphase/distance/vertex_facet.h"

namespace tact::narrowphase {

namespace {

// Without those that have a bit in `left_out`, one for each vertex of the mesh.
std::uint64_t without(std::span<const std::uint64_t> left_out, std::uint64_t some, const FeatureBlock& vertices) {
  std::uint64_t rest = some;
  for (std::uint64_t left = left_out.empty() ? 0 : some; left != 0; left &= left - 1) {
    const auto vertex = static_cast<std::size_t>(vertices.feature[std::countr_zero(left)]);
    if ((left_out[vertex / 64] >> vertex % 64 & 1) != 0) rest &= ~(left & -left);
  }
  return rest;
}

// Whether a corner of a facet certainly has no point with the facet's other features: it lies on the inner side of the
// edge between the other two corners, and each of these leads nearer to it.
bool has_no_point_with_itself(std::size_t k, const Vec3 (&corner)[3]) {
  const Vec3 v = corner[k], p = corner[(k + 1) % 3], q = corner[(k + 2) % 3], side = q - p, away = v - p;
  const double length = norm_squared(side), square = norm_squared(away), along = dot(away, side);
  const auto leads = [](double squared) { return certain_sign(squared, squared * squared) > 0; };
  return leads(square) && leads(norm_squared(v - q)) &&
         certain_sign(square * length - along * along, length * length * (square * square)) > 0;
}

// Those of some facets whose corners have no points with them, of a cluster and itself.
std::uint64_t settled_facets(const OpenFeatures& open, std::uint64_t some) {
  std::uint64_t settled = 0;
  for (; some != 0; some &= some - 1) {
    const int k = std::countr_zero(some);
    const auto at = [&](int c) { return point_of(open.points, open.facets.corner[c][k]); };
    const Vec3 corner[3] = {at(0), at(1), at(2)};
    if (has_no_point_with_itself(0, corner) && has_no_point_with_itself(1, corner) &&
        has_no_point_with_itself(2, corner))
      settled |= some & -some;
  }
  return settled;
}

}  // namespace

void PointFinder::search(const OpenFeatures& a, const OpenFeatures& b) {
  const auto from_vertices = [&](const OpenFeatures& one, const OpenFeatures& other, const NearFacets& near,
                                 FeaturePair kind) { this->from_vertices(one, other, near, kind); };
  for_near_features(a, b, same_, from_vertices, [&](const EdgeBlocks& edges) {
    for_edges_between(edges, kernels().near_edges, reach_, [&](int e, int f) { add_edges(e, f); });
  });
}

void PointFinder::finish() {
  waiting_.visit_all(a_, b_, reach_, EdgeSide::before, [&](int e, int f) { look_at_edges(e, f); });
}

void PointFinder::from_vertices(const OpenFeatures& one, const OpenFeatures& other, const NearFacets& near,
                                FeaturePair kind) {
  const bool of_a = kind == FeaturePair::vertex_facet;
  std::span<const std::uint64_t> left_out;
  if (rules_.crossing != nullptr) left_out = rules_.crossing->surfaces[of_a ? 0 : 1].without_near_points;
  const std::uint64_t settled = same_ && one.cluster == other.cluster ? settled_facets(other, near.facets) : 0;
  for (int block = 0; block < one.vertex_blocks; ++block) {
    const FeatureBlock& vertices = one.vertices[block];
    std::uint64_t some = kernels().near_facets(vertices.cells, base::lowest_bits(vertices.count), near.cells);
    some = without(left_out, some, vertices);
    for_near_vertices({one.points, vertices, some}, {other.points, other.facets, near.facets}, settled, reach_,
                      [&](int i, int k, bool is_inside) {
                        const auto corner = [&](int c) { return point_of(other.points, other.facets.corner[c][k]); };
                        const VertexAndFacet pair{of_a ? a_ : b_,
                                                  of_a ? b_ : a_,
                                                  kind,
                                                  vertices.feature[i],
                                                  other.facets.feature[k],
                                                  point_of(one.points, vertices.corner[0][i]),
                                                  {corner(0), corner(1), corner(2)}};
                        if (same_ && is_settled_corner(pair)) return;
                        if (is_inside) look_inside_facet(pair);
                        look_at_border(pair);
                      });
  }
}

// Of a mesh with itself: a third of all facets that are near a vertex are its own.
bool PointFinder::is_settled_corner(const VertexAndFacet& one) const {
  const Corners& corners = one.surface.features.corners(one.facet);
  for (std::size_t k = 0; k < 3; ++k) {
    if (corners[k] == one.vertex) return has_no_point_with_itself(k, one.corner);
  }
  return false;
}

void PointFinder::look_inside_facet(const VertexAndFacet& one) {
  const Features& features = one.surface.features;
  if ((features.firsts_of_facet(one.facet) & Features::kRepeatsFacet) != 0) return;
  if (const auto nearest = nearest_inside_facet(one.v, one.corner, reach_))
    add_vertex_point(one, features.corners(one.facet), *nearest);
}

// Points on those edges and vertices that have the facet as their first one.
void PointFinder::look_at_border(const VertexAndFacet& one) {
  const int facet = one.facet;
  const Features& features = one.surface.features;
  unsigned first = features.firsts_of_facet(facet) & 63u;
  if (first != 0) first &= border_of(one.v, one.corner, reach_);
  if (first == 0) return;
  const Corners& corners = features.corners(facet);
  const auto add = [&](const std::optional<Nearest>& nearest, std::span<const int> feature) {
    if (nearest) add_vertex_point(one, feature, *nearest);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    if ((first >> c & 1) != 0) {
      const int edge = features.facet_edge(facet, static_cast<int>(c));
      const EdgeVertices ends = features.edge(edge);
      const bool forward = ends[0] == corners[c];
      add(nearest_inside_edge(one.v, one.corner[forward ? c : next], one.corner[forward ? next : c],
                              one.surface.around(features.opposite(edge)), reach_),
          ends);
    }
    const int w = corners[c];
    if ((first >> (3 + c) & 1) != 0 && !(same_ && w == one.vertex))
      add(nearest_in_vertex(one.v, one.corner[c], one.surface.around(features.neighbors(w)), reach_), {&w, 1});
  }
}

void PointFinder::add_vertex_point(const VertexAndFacet& pair, std::span<const int> feature, const Nearest& nearest) {
  const auto& [m, surface, kind, vertex, facet, v, corner] = pair;
  const bool of_a = kind == FeaturePair::vertex_facet;
  const Vec3 way = nearest.normal == Vec3{} ? way_where_they_touch(surface, feature, of_a) : nearest.normal;
  const std::span<const int> own(&vertex, 1);
  if (nearest.distance > 0.0 && runs_inside(of_a ? own : feature, of_a ? feature : own, of_a ? way : -way)) return;
  if (same_) {
    if (rules_.crossing != nullptr && leads_back(*rules_.crossing, m.mesh.source_vertex(vertex), way)) return;
    const Vec3 place = v + nearest.distance * nearest.normal;
    if (too_near_along(a_, reach_, {{&vertex, 1}, v}, {feature, place}, ways_)) return;
  }
  PlaceOnFeature place;
  std::ranges::copy(feature, place.vertices.begin());
  std::ranges::copy(nearest.weight, place.weight.begin());
  add(point_of_vertex(kind, m.mesh, vertex, surface.mesh, place, way, nearest.distance / m.scale));
}

// Towards the inside of a surface that a vertex of a, or of b, touches.
Vec3 PointFinder::way_where_they_touch(const ScaledMesh& surface, std::span<const int> feature, bool of_a) const {
  const Vec3 along = rules_.crossing != nullptr ? rules_.crossing->direction : rules_.touching;
  const Turned turned = rules_.crossing != nullptr ? Turned::as_it_is : Turned::either_way;
  const Vec3 normal = touching_normal(surface, feature, of_a ? -along : along, turned);
  return normal == Vec3{} ? Vec3{0.0, 0.0, -1.0} : -normal;
}

void PointFinder::add_edges(int e, int f) {
  if (same_ && share_a_vertex(a_.features.edge(e), b_.features.edge(f))) return;
  waiting_.add(a_, e, b_, f, reach_, EdgeSide::before, [&](int edge, int other) { look_at_edges(edge, other); });
}

void PointFinder::look_at_edges(int e, int f) {
  const EdgeEnds at_e = a_.ends(e);
  const auto nearest = nearest_between_edges(at_e, a_.beside(e), b_.ends(f), b_.beside(f), reach_);
  if (nearest) add_edge_point(e, at_e, f, *nearest);
}

void PointFinder::add_edge_point(int edge_e, const EdgeEnds& at_e, int edge_f, const Nearest& nearest) {
  const EdgeVertices e = a_.features.edge(edge_e), f = b_.features.edge(edge_f);
  const Vec3 on_e = nearest.first[0] * at_e.p + nearest.first[1] * at_e.q;
  if (same_ && too_near_along(a_, reach_, {e, on_e}, {f, on_e + nearest.distance * nearest.normal}, ways_)) return;
  FeaturePoint point = point_of_edges(nearest, a_, edge_e, b_, edge_f, nearest.distance / a_.scale);
  if (same_) {
    if (point.b < point.a) {
      std::swap(point.a, point.b);
      std::swap(point.weight_a, point.weight_b);
      std::swap(point.edge_a, point.edge_b);
      point.normal = -point.normal;
    }
    point.normal = point.normal + Vec3{};  // the sign of a zero would tell which edge was the first
  }
  if (rules_.crossing == nullptr) {
    if (!(nearest.distance > 0.0 && runs_inside(e, f, nearest.normal))) add(point);
    return;
  }
  if (const auto other = point_of_near_edges(*rules_.crossing, point, ways_)) add(*other);
}

// Whether the way from a to b along the normal begins or ends inside the body that it leaves or reaches.
bool PointFinder::runs_inside(std::span<const int> of_a, std::span<const int> of_b, Vec3 normal) const {
  return (rules_.a_is_solid && leads_inside({&a_.mesh, &a_.features}, of_a, normal)) ||
         (rules_.b_is_solid && leads_inside({&b_.mesh, &b_.features}, of_b, -normal));
}

// What touches in a vertex or an edge has no side of its own.
void PointFinder::add(FeaturePoint point) {
  if (point.gap == 0.0 && dot(point.normal, rules_.touching) < 0.0) point.normal = -point.normal;
  found_.push_back(point);
}

}  // namespace tact::narrowphase

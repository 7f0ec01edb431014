#include "narrowphase/contact_points/point_finder.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "narrowphase/contact_points/own_inside.h"
#include "narrowphase/crossing/crossing_points.h"
#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/distance/facet_border.h"
#include "narrowphase/distance/vertex_facet.h"

namespace tact::narrowphase {

namespace {

Vec3 point_of(const ClusterPoints& points, int i) { return {points.at[0][i], points.at[1][i], points.at[2][i]}; }

// Without those that have a bit in `left_out`, one for each vertex of the mesh.
std::uint64_t without(std::span<const std::uint64_t> left_out, std::uint64_t some, const FeatureBlock& vertices) {
  std::uint64_t rest = some;
  for (std::uint64_t left = left_out.empty() ? 0 : some; left != 0; left &= left - 1) {
    const auto vertex = static_cast<std::size_t>(vertices.feature[std::countr_zero(left)]);
    if ((left_out[vertex / 64] >> vertex % 64 & 1) != 0) rest &= ~(left & -left);
  }
  return rest;
}

Vec3 facet_normal(const ScaledMesh& m, int facet) {
  const Vec3 normal = m.normal(facet);
  return normal == Vec3{} ? Vec3{0.0, 0.0, 1.0} : normalized(normal);
}

}  // namespace

void PointFinder::search(const OpenFeatures& a, const OpenFeatures& b) {
  if (a.facets.count == 0 || b.facets.count == 0) return;
  const Near near_a = near_facets(a, b.cells), near_b = near_facets(b, a.cells);
  if (near_a.facets == 0 || near_b.facets == 0) return;
  from_vertices(a, b, near_b, FeaturePair::vertex_facet);
  if (!same_) from_vertices(b, a, near_a, FeaturePair::facet_vertex);
  if (same_ && a.cluster != b.cluster) from_vertices(b, a, near_a, FeaturePair::vertex_facet);
  between_edges(a, near_a, b, near_b);
}

void PointFinder::finish() {
  waiting_.visit_all(a_, b_, reach_, EdgeSide::before, [&](int e, int f) { look_at_edges(e, f); });
}

PointFinder::Near PointFinder::near_facets(const OpenFeatures& one, const CellBox& other) {
  Near near;
  near.facets = kernels().near_facets(one.facets.cells, all_of(one.facets.count), other);
  if (near.facets != 0) near.cells = kernels().cells_of(one.facets.cells, near.facets);
  return near;
}

void PointFinder::from_vertices(const OpenFeatures& one, const OpenFeatures& other, const Near& near,
                                FeaturePair kind) {
  std::uint64_t met[FeatureBlock::kCapacity], inside[FeatureBlock::kCapacity];
  const bool of_a = kind == FeaturePair::vertex_facet;
  std::span<const std::uint64_t> left_out;
  if (rules_.crossing != nullptr) left_out = rules_.crossing->surfaces[of_a ? 0 : 1].without_near_points;
  for (int block = 0; block < one.vertex_blocks; ++block) {
    const FeatureBlock& vertices = one.vertices[block];
    std::uint64_t some = kernels().near_facets(vertices.cells, all_of(vertices.count), near.cells);
    some = without(left_out, some, vertices);
    std::uint64_t left = kernels().near_vertices({one.points, vertices, some},
                                                 {other.points, other.facets, near.facets}, reach_, met, inside);
    for (; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      for (std::uint64_t rest = met[i]; rest != 0; rest &= rest - 1) {
        const int k = std::countr_zero(rest);
        const auto corner = [&](int c) { return point_of(other.points, other.facets.corner[c][k]); };
        const VertexAndFacet pair{of_a ? a_ : b_,
                                  of_a ? b_ : a_,
                                  kind,
                                  vertices.feature[i],
                                  other.facets.feature[k],
                                  point_of(one.points, vertices.corner[0][i]),
                                  {corner(0), corner(1), corner(2)}};
        if ((inside[i] >> k & 1) != 0) look_inside_facet(pair);
        look_at_border(pair);
      }
    }
  }
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
  unsigned first = features.firsts_of_facet(facet) & ~Features::kRepeatsFacet;
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
  const Vec3 way = nearest.normal == Vec3{} ? -facet_normal(surface, facet) : nearest.normal;
  const bool of_a = kind == FeaturePair::vertex_facet;
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

void PointFinder::between_edges(const OpenFeatures& a, const Near& near_a, const OpenFeatures& b, const Near& near_b) {
  std::uint64_t some_b[OpenFeatures::kMostBlocks];
  for (int k = 0; k < b.edge_blocks; ++k)
    some_b[k] = kernels().near_facets(b.edges[k].cells, all_of(b.edges[k].count), near_a.cells);
  for (int i = 0; i < a.edge_blocks; ++i) {
    const std::uint64_t some_a = kernels().near_facets(a.edges[i].cells, all_of(a.edges[i].count), near_b.cells);
    for (int k = 0; some_a != 0 && k < b.edge_blocks; ++k) between_blocks(a, i, some_a, b, k, some_b[k]);
  }
}

void PointFinder::between_blocks(const OpenFeatures& a, int block_a, std::uint64_t some_a, const OpenFeatures& b,
                                 int block_b, std::uint64_t some_b) {
  const PlacedFeatures of_a{a.points, a.edges[block_a], some_a}, of_b{b.points, b.edges[block_b], some_b};
  const bool few_are_a = std::popcount(some_a) <= std::popcount(some_b);
  std::uint64_t met[FeatureBlock::kCapacity];
  std::uint64_t left = kernels().near_edges(few_are_a ? of_a : of_b, few_are_a ? of_b : of_a, reach_, met);
  for (; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    for (std::uint64_t rest = met[i]; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest), e = few_are_a ? i : k, f = few_are_a ? k : i;
      add_edges(a.edges[block_a].feature[e], b.edges[block_b].feature[f], a.cluster == b.cluster);
    }
  }
}

void PointFinder::add_edges(int e, int f, bool in_one_cluster) {
  if (same_ && (share_a_vertex(a_.features.edge(e), b_.features.edge(f)) || (in_one_cluster && e > f))) return;
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

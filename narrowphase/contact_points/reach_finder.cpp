#include "narrowphase/contact_points/reach_finder.h"

#include <algorithm>
#include <utility>

#include "engine/base/lowest_bits.h"
#include "narrowphase/distance/closest_places.h"

namespace tact::narrowphase {

namespace {

// A facet that names a vertex twice has it once, with both weights.
void put_facet(const ScaledMesh& m, const Corners& corners, const std::array<double, 3>& weights,
               std::array<int, 3>& vertices, std::array<double, 3>& weight) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int vertex = m.mesh.source_vertex(corners[k]);
    const auto known =
        static_cast<std::size_t>(std::find(vertices.begin(), vertices.begin() + count, vertex) - vertices.begin());
    if (known == count) vertices[count++] = vertex;
    weight[known] += weights[k];
  }
}

bool is_point(const Corners& corners) { return corners[0] == corners[1] && corners[0] == corners[2]; }

bool is_point(const ScaledMesh& m, int vertex) {
  return std::ranges::any_of(m.features.facets_at(vertex),
                             [&](int facet) { return is_point(m.features.corners(facet)); });
}

}  // namespace

void ReachFinder::search(const OpenFeatures& a, const OpenFeatures& b) {
  const auto from_vertices = [&](const OpenFeatures& one, const OpenFeatures& other, const NearFacets& near,
                                 FeaturePair kind) { this->from_vertices(one, other, near, kind); };
  for_near_features(a, b, same_, from_vertices, [&](const EdgeBlocks& edges) {
    for_edges_between(edges, kernels().close_edges, reach_, [&](int e, int f) {
      if (same_ && share_a_vertex(a_.features.edge(e), b_.features.edge(f))) return;
      add_edges(e, f);
    });
  });
}

void ReachFinder::from_vertices(const OpenFeatures& one, const OpenFeatures& other, const NearFacets& near,
                                FeaturePair kind) {
  const std::uint64_t own = same_ && one.cluster == other.cluster ? near.facets : 0;
  for (int block = 0; block < one.vertex_blocks; ++block) {
    const FeatureBlock& vertices = one.vertices[block];
    const std::uint64_t some = kernels().near_facets(vertices.cells, base::lowest_bits(vertices.count), near.cells);
    for_near_vertices(
        {one.points, vertices, some}, {other.points, other.facets, near.facets}, own, reach_, [&](int i, int k, bool) {
          add_vertex(kind, vertices.feature[i], point_of(one.points, vertices.corner[0][i]), other.facets.feature[k]);
        });
  }
}

void ReachFinder::add_vertex(FeaturePair kind, int vertex, Vec3 v, int facet) {
  const bool of_a = kind == FeaturePair::vertex_facet;
  const ScaledMesh &m = of_a ? a_ : b_, &surface = of_a ? b_ : a_;
  const Corners& corners = surface.features.corners(facet);
  if (same_ && std::ranges::find(corners, vertex) != corners.end()) return;
  if ((surface.features.firsts_of_facet(facet) & Features::kRepeatsVertices) != 0) return;
  // Two points are one pair: that of a's vertex, of one mesh that of the lesser one.
  const bool comes_second = same_ ? m.mesh.source_vertex(vertex) > m.mesh.source_vertex(corners[0]) : !of_a;
  if (comes_second && is_point(corners) && is_point(m, vertex)) return;
  const ClosestPlaces places = closest_of_vertex_and_facet(v, surface.triangle(facet));
  if (!(places.distance < reach_)) return;
  const Vec3 normal = of_a ? places.normal : -places.normal;
  ReachPair pair{.kind = kind,
                 .normal = {normal.x + 0.0, normal.y + 0.0, normal.z + 0.0},  // no zero has a sign
                 .distance = places.distance / m.scale};
  (of_a ? pair.a_vertices : pair.b_vertices)[0] = m.mesh.source_vertex(vertex);
  (of_a ? pair.a_weights : pair.b_weights)[0] = 1.0;
  put_facet(surface, corners, places.second, of_a ? pair.b_vertices : pair.a_vertices,
            of_a ? pair.b_weights : pair.a_weights);
  found_.push_back(pair);
}

// Of one mesh the edges change places before anything is computed: no bit tells which was found first.
void ReachFinder::add_edges(int edge_a, int edge_b) {
  std::array<int, 3> first = source_vertices(a_.mesh, a_.features.edge(edge_a)),
                     second = source_vertices(b_.mesh, b_.features.edge(edge_b));
  if (same_ && second < first) {
    std::swap(first, second);
    std::swap(edge_a, edge_b);
  }
  const ClosestPlaces places = closest_of_edges(a_.ends(edge_a), b_.ends(edge_b), reach_);
  if (!(places.distance < reach_)) return;
  found_.push_back({.kind = FeaturePair::edge_edge,
                    .a_vertices = first,
                    .b_vertices = second,
                    .a_weights = places.first,
                    .b_weights = places.second,
                    .normal = {places.normal.x + 0.0, places.normal.y + 0.0, places.normal.z + 0.0},
                    .distance = places.distance / a_.scale});
}

}  // namespace tact::narrowphase

// The edges of a mesh and what lies around each edge and vertex: what tells whether a point of a surface is nearest
// among its neighbours. It depends on facets alone, so it is made once and holds while the mesh moves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

using EdgeVertices = std::array<int, 2>;

/// The numbers of a cluster's vertices: FeatureCorners of vertices alone. 64 more than there can be may be read.
inline constexpr auto kEachVertex = [] {
  std::array<std::uint8_t, ClusterPoints::kRoom> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint8_t>(i);
  return numbers;
}();

class Features {
 public:
  explicit Features(const ClusteredMesh& mesh);

  /// Edges are ordered by the first facet that has them: those of a cluster follow each other.
  int edge_count() const { return static_cast<int>(edges_.size()); }
  int edge_begin(int cluster) const { return edge_begin_[cluster]; }
  int edge_end(int cluster) const { return edge_begin(cluster + 1); }
  /// The two vertices, in the order of the caller's numbers. They differ.
  EdgeVertices edge(int edge) const { return edges_[edge]; }
  /// The same of the edges from that one on, as their cluster counts vertices (ClusterFacets::corner), one array a
  /// vertex; 64 bytes of each may be read.
  std::array<const std::uint8_t*, 2> edge_corners(int edge) const {
    return {edge_corner_[0].data() + edge, edge_corner_[1].data() + edge};
  }
  /// The third vertex of each facet that has the edge.
  std::span<const int> opposite(int edge) const { return part(opposite_, opposite_begin_, edge); }
  /// What the mesh tells of a facet's vertices, without a look at its cluster.
  const Corners& corners(int facet) const { return corners_[facet]; }
  /// The edge from corner k of a facet to the next one; negative if these are one vertex.
  int facet_edge(int facet, int k) const {
    return facet_edges_[3 * static_cast<std::size_t>(facet) + static_cast<std::size_t>(k)];
  }
  /// The facets that have a vertex, each once.
  std::span<const int> facets_at(int vertex) const { return part(facets_, facets_begin_, vertex); }
  /// Whether facets go along every edge as often one way as the other.
  bool is_closed() const { return is_closed_; }
  /// Among the facets that have a vertex the caller's first.
  int first_facet_of_vertex(int vertex) const { return first_facet_of_vertex_[vertex]; }
  /// Bit k: of the facets with the edge from corner k this one is the caller's first; bit 3 + k: the same of the vertex
  /// at corner k. Each edge and vertex has a bit once. kRepeatsFacet: a facet that the caller listed before has the
  /// same vertices.
  unsigned firsts_of_facet(int facet) const { return firsts_of_facet_[facet]; }
  static constexpr unsigned kRepeatsFacet = 1u << 6;
  /// Likewise, but for how often each vertex is named: of segments, which name one twice, and points.
  static constexpr unsigned kRepeatsVertices = 1u << 7;
  /// The vertices that share an edge with a vertex, each once.
  std::span<const int> neighbors(int vertex) const { return part(neighbors_, neighbors_begin_, vertex); }
  /// The vertex that has a number of the caller's; -1 if no facet uses it.
  int vertex_of_source(int source_vertex) const { return vertex_of_source_[source_vertex]; }
  /// Whether no facet of the surface has the vertices of a feature, which are the caller's: see WithoutArea. -1 fills
  /// up.
  bool is_bare(const std::array<int, 3>& source_vertices) const;
  /// See mesh_parts.h.
  std::span<const int> one_of_each_part() const { return one_of_each_part_; }

  /// Prefetches what is known of a cluster's edges, facets and vertices.
  void prefetch(const ClusteredMesh& mesh, int cluster) const;

 private:
  static std::span<const int> part(const std::vector<int>& all, const std::vector<int>& begin, int i) {
    const auto k = static_cast<std::size_t>(i);
    return std::span(all).subspan(begin[k], begin[k + 1] - begin[k]);
  }
  void find_corners(const ClusteredMesh& mesh);
  void find_edges(const ClusteredMesh& mesh);
  void find_ends(const ClusteredMesh& mesh, int count);
  void find_opposite();
  void find_repeated(const ClusteredMesh& mesh);
  void mark_repeated(const ClusteredMesh& mesh, std::vector<std::pair<Corners, int>>& sorted, unsigned mark);
  void find_neighbors(const ClusteredMesh& mesh);
  void find_firsts(const ClusteredMesh& mesh);
  void find_facets_at(const ClusteredMesh& mesh);
  void find_bare(const ClusteredMesh& mesh);

  std::vector<EdgeVertices> edges_;
  std::vector<std::uint8_t> edge_corner_[2];
  std::vector<int> edge_begin_;  // by cluster, and one more
  std::vector<int> opposite_, opposite_begin_;
  std::vector<Corners> corners_;
  std::vector<int> facet_edges_;
  std::vector<int> first_facet_of_vertex_;
  std::vector<std::uint8_t> firsts_of_facet_;
  std::vector<int> neighbors_, neighbors_begin_;
  std::vector<int> facets_, facets_begin_;
  std::vector<int> one_of_each_part_;
  std::vector<int> vertex_of_source_;
  bool is_closed_ = true;
  std::vector<bool> vertex_is_bare_;      // of each vertex; empty where the mesh is a surface alone
  std::vector<EdgeVertices> bare_edges_;  // in the caller's numbers, sorted
};

/// A mesh and its features.
struct FeaturedMesh {
  const ClusteredMesh* mesh = nullptr;
  const Features* features = nullptr;
};

/// The caller's numbers of up to three vertices; -1 fills up.
std::array<int, 3> source_vertices(const ClusteredMesh& mesh, std::span<const int> vertices);

/// True if two edges have a vertex in common.
inline bool share_a_vertex(const EdgeVertices& e, const EdgeVertices& f) {
  return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
}

}  // namespace tact::narrowphase

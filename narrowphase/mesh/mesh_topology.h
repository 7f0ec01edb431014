// What of a mesh does not move: its facets in clusters of up to 64 neighbours, and its vertices cluster by cluster.
//
// Vertices are renumbered. A vertex belongs to the first cluster that uses it, its *owner*. The vertices of a cluster
// stand next to each other, in the caller's order. A cluster borrows the other vertices that it uses from earlier
// clusters, so a refit in order reads each vertex of the caller once. A vertex that no facet uses is left out. "vertex"
// means the new number, "source vertex" the caller's; likewise "facet" and "source facet".
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/facet_order.h"
#include "narrowphase/mesh/mesh_memory.h"

namespace tact::narrowphase {

/// The three vertices of a facet.
using Corners = std::array<int, 3>;

class MeshTopology {
 public:
  /// Of the arrays in `memory`, which stay where they are as long as this is used.
  MeshTopology(const MeshMemory& memory, const MeshCounts& counts);

  const MeshCounts& counts() const { return counts_; }
  int source_vertex_count() const { return counts_.source_vertices; }
  int vertex_count() const { return counts_.vertices; }
  int facet_count() const { return counts_.facets; }
  int cluster_count() const { return counts_.clusters(); }
  int group_count() const { return counts_.groups(); }

  int source_facet(int facet) const { return source_facet_[facet]; }
  int facet_of_source(int source_facet) const { return source_facet_[counts_.facets + source_facet]; }
  int source_vertex(int vertex) const { return source_vertices()[vertex]; }
  const int* source_vertices() const { return ranges_ + 2 * cluster_count() + 2; }
  std::span<const int> unused_source_vertices() const {
    return {unused_sources_, static_cast<std::size_t>(counts_.unused)};
  }

  /// The clusters of a group are cluster_begin(g) <= c < cluster_end(g).
  int cluster_begin(int group) const { return group * kGroupSize; }
  int cluster_end(int group) const { return std::min((group + 1) * kGroupSize, cluster_count()); }
  /// The facets of a cluster are facet_begin(c) <= f < facet_end(c).
  int facet_begin(int cluster) const { return cluster * kClusterSize; }
  int facet_end(int cluster) const { return std::min((cluster + 1) * kClusterSize, facet_count()); }
  /// The vertices that a cluster owns are vertex_begin(c) <= v < vertex_end(c).
  int vertex_begin(int cluster) const { return ranges_[2 * cluster]; }
  int vertex_end(int cluster) const { return vertex_begin(cluster + 1); }

  Corners corners(int facet) const;
  /// A cluster as the kernels take it; `points` are the positions of all vertices.
  ClusterFacets facets_of(int cluster, const PointArrays& points) const;
  /// The facets of a cluster in the caller's numbers.
  const int* source_facets_of(int cluster) const { return source_facet_ + facet_begin(cluster); }

  /// What a refit reads, one array after the other: of each cluster and one more where the vertices begin that it owns
  /// and that it borrows; the source vertices of all vertices; the source vertices of all that clusters borrow.
  std::span<const int> refit_indices() const {
    return {ranges_, static_cast<std::size_t>(2 * cluster_count() + 2 + vertex_reads())};
  }
  /// The vertices that clusters borrow, cluster by cluster.
  const int* borrowed_vertices() const { return borrowed_; }
  const int* borrowed_source_vertices() const { return source_vertices() + counts_.vertices; }
  /// How many vertices of the caller a refit reads for clusters: those that several clusters share more than once.
  int vertex_reads() const { return counts_.vertices + counts_.borrowed; }

 protected:
  /// Copies all to other memory and goes on there.
  void move_to(const MeshMemory& memory);

 private:
  // What a refit needs comes first.
  MeshCounts counts_;
  const int* ranges_;
  const int* unused_sources_;
  const int* borrowed_;         // vertices that a cluster uses and does not own, cluster by cluster
  const int* source_facet_;     // of each facet; after them the facets of the source facets
  const std::uint8_t* corner_;  // see MeshArrays: vertices that the facet's cluster owns come first, then the borrowed
};

}  // namespace tact::narrowphase

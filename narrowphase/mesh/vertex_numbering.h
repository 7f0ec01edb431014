// How the vertices of a mesh are numbered, once its facets have an order: cluster by cluster.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tact::narrowphase {

/// The numbers that MeshTopology shows; see there what a cluster owns and what it borrows.
struct VertexNumbering {
  std::vector<int> ranges;              ///< of each cluster and one more: its first vertex, the first that it borrows
  std::vector<int> source_vertices;     ///< of each vertex
  std::vector<int> borrowed;            ///< vertices, cluster by cluster
  std::vector<int> borrowed_sources;    ///< the source vertices of these
  std::vector<int> unused_sources;      ///< source vertices that no facet uses
  std::vector<std::uint8_t> corner[3];  ///< of each facet, counted in its cluster: owned vertices first, then borrowed
};

/// Numbers the vertices of facets, given as 3 x F source vertices, that clusters take in this order.
VertexNumbering number_vertices(std::span<const int> facets, std::span<const int> order, int source_vertex_count);

}  // namespace tact::narrowphase

// How the vertices, edges and facets of a mesh hang together. It does not change as the mesh deforms.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace tact::scenes {

struct Edge {
  int from = 0;          // the lower vertex
  int to = 0;            // the higher vertex
  int facet = 0;         // the lowest facet that has this edge
  int other_facet = -1;  // the next; -1 at the rim of a sheet
};

struct Neighbor {
  int vertex = 0;
  int edge = 0;  // the edge that leads there
};

class Topology {
 public:
  Topology() = default;
  // `facets` is 3 x F, with indices from 0 to vertex_count - 1.
  Topology(const Eigen::Matrix3Xi& facets, int vertex_count);

  // Each edge once, sorted by (from, to).
  const std::vector<Edge>& edges() const { return edges_; }
  // The edge of `facet` that leads from its corner k to the next.
  int edge_of(int facet, int corner) const { return facet_edges_(corner, facet); }
  // The vertices that share an edge with `vertex`, ascending.
  std::span<const Neighbor> neighbors(int vertex) const;

 private:
  std::vector<Edge> edges_;
  Eigen::Matrix3Xi facet_edges_{3, 0};
  std::vector<std::size_t> first_neighbor_;  // by vertex, one more at the end
  std::vector<Neighbor> neighbors_;
};

}  // namespace tact::scenes

// The facets around each vertex of a mesh, in their order, and whether they lie open: have no points in common but
// those of the edges and the vertex that they share. The order depends on facets alone, so it is made once and holds
// while the mesh moves.
//
// **What is proved.** The facets at a vertex v follow each other, each with a common edge, in one row that may close.
// Let w be a direction with n · w > 0 for the normal n of every facet, turned as the row goes. Seen along w they are
// then triangles at one point, each with an angle of less than 180 degrees, one after the other, and all turn the same
// way. Do they turn by less than 360 degrees together, or by just that if the row is closed, none overlaps another one,
// and two of them have at most the line of an edge in common, above which each has that edge alone.
//
// That they turn no farther is seen from the sides of the first edge's line on which the other edges are: first on the
// left, then on the right, then never on the left again.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

class VertexFans {
 public:
  explicit VertexFans(const ClusteredMesh& mesh);

  /// The other ends of the edges at a vertex: two that follow each other are of one facet. Where the row is closed, the
  /// first stands once more at the end. Empty where the facets are not such a row, as where three have an edge.
  std::span<const int> around(int vertex) const {
    return std::span(around_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }
  /// True if the facets at a vertex certainly lie open. `sides` is memory, used again.
  bool lie_open(const ClusteredMesh& mesh, int vertex, std::vector<Vec3>& sides) const;

 private:
  std::vector<int> around_, begin_;
};

}  // namespace tact::narrowphase

// The edges of a mesh, each with the facets that it joins. They do not change as the mesh deforms.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tact::scenes {

struct Edge {
  int from = 0;          // the lower vertex
  int to = 0;            // the higher vertex
  int facet = 0;         // the lowest facet that has this edge
  int other_facet = -1;  // the next; -1 at the rim of a sheet
};

// Each edge of the facets (3 x F) once, sorted by (from, to).
std::vector<Edge> edges_of(const Eigen::Matrix3Xi& facets);

}  // namespace tact::scenes

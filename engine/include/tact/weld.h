// Welding: one vertex where several have one position.
#pragma once

#include <tact/columns.h>
#include <tact/error.h>

#include <Eigen/Core>
#include <vector>

namespace tact {

/// A mesh in which no two vertices have equal positions.
struct WeldedMesh {
  Eigen::Matrix3Xd positions;  ///< of each place the first vertex that was given. Metres, 3 x V
  Eigen::Matrix3Xi facets;     ///< all that were given, in their order. Indices, 3 x F
  std::vector<int> vertex_of;  ///< for each vertex that was given, its vertex in this mesh
  int merged_vertices = 0;     ///< how many vertices became one with an earlier vertex
  int collapsed_facets = 0;    ///< how many facets have a vertex twice that had three
};

/// Returns a mesh without the vertices that repeat an earlier position; 0 and -0 are equal. Errors: wrong_size,
/// too_large, non_finite_position, position_out_of_range, facet_out_of_range.
TACT_API WeldedMesh weld(const Positions& positions, const Facets& facets);

}  // namespace tact

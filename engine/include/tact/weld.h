// Welding: one vertex where several have one position.
#pragma once

#include <tact/columns.h>
#include <tact/error.h>

#include <Eigen/Core>
#include <utility>
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

/// The arrays of a WeldedMesh, a column after the other.
struct WeldedArrays {
  std::vector<double> positions;
  std::vector<int> facets;
  std::vector<int> vertex_of;
  int merged_vertices = 0;
  int collapsed_facets = 0;
};

/// Returns what weld() does, as arrays. Errors: likewise.
TACT_API WeldedArrays weld_arrays(const Positions& positions, const Facets& facets);

// The matrices are made here: Eigen aligns memory as the flags of the program say, which need not be the library's.
/// Returns a mesh without the vertices that repeat an earlier position; 0 and -0 are equal. Errors: wrong_size,
/// too_large, non_finite_position, position_out_of_range, facet_out_of_range.
inline WeldedMesh weld(const Positions& positions, const Facets& facets) {
  WeldedArrays arrays = weld_arrays(positions, facets);
  const auto columns = [](const auto& array) { return static_cast<Eigen::Index>(array.size() / 3); };
  WeldedMesh mesh;
  mesh.positions = Eigen::Map<const Eigen::Matrix3Xd>(arrays.positions.data(), 3, columns(arrays.positions));
  mesh.facets = Eigen::Map<const Eigen::Matrix3Xi>(arrays.facets.data(), 3, columns(arrays.facets));
  mesh.vertex_of = std::move(arrays.vertex_of);
  mesh.merged_vertices = arrays.merged_vertices;
  mesh.collapsed_facets = arrays.collapsed_facets;
  return mesh;
}

}  // namespace tact

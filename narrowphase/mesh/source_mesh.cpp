#include "narrowphase/mesh/source_mesh.h"

#include <cstddef>

namespace tact::narrowphase {

std::vector<int> source_facets(const ClusteredMesh& mesh) {
  std::vector<int> facets(3 * static_cast<std::size_t>(mesh.facet_count()));
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Corners c = mesh.corners(f);
    for (std::size_t k = 0; k < 3; ++k)
      facets[3 * static_cast<std::size_t>(mesh.source_facet(f)) + k] = mesh.source_vertex(c[k]);
  }
  return facets;
}

std::vector<double> source_positions(const ClusteredMesh& mesh, const PointArrays& points) {
  std::vector<double> positions(3 * static_cast<std::size_t>(mesh.source_vertex_count()), 0.0);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    double* const to = &positions[3 * static_cast<std::size_t>(mesh.source_vertex(v))];
    to[0] = points.x[v], to[1] = points.y[v], to[2] = points.z[v];
  }
  return positions;
}

}  // namespace tact::narrowphase

// A test mesh as the narrow phase takes it.
#pragma once

#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/mesh.h"

namespace tact::tests {

inline narrowphase::ClusteredMesh clustered(const Mesh& mesh) {
  return {{mesh.positions.data(), static_cast<std::size_t>(mesh.positions.size())},
          {mesh.facets.data(), static_cast<std::size_t>(mesh.facets.size())}};
}

inline narrowphase::ClusteredMesh clustered_box(Vec3 lower, Vec3 upper) { return clustered(box(lower, upper)); }

// Meshes whose vertices are often equally high, or of very different size.
inline std::vector<Mesh> meshes_with_ties() {
  return {box({0, 0, 0}, {1, 2, 3}),
          blob(3, 1.0, 0.3, 1),
          wrinkled_sheet(40, 2.0, 0.2, 2),
          lattice_soup(500, 2, 3),
          wrinkled_sheet(60, 2.0, 0.2, 2),
          needles(100, 1e9, 4),
          sheet(1, 1, 1.0, 1.0)};
}

// The order in which its facets stand in the clusters.
inline std::vector<int> facet_order_of(const Mesh& mesh) {
  return narrowphase::facet_order({mesh.positions.data(), static_cast<std::size_t>(mesh.positions.size())},
                                  {mesh.facets.data(), static_cast<std::size_t>(mesh.facets.size())},
                                  mesh.vertex_count());
}

}  // namespace tact::tests

// The least distance of two meshes, as they are now.
#pragma once

#include <array>
#include <optional>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/plane/half_space.h"

namespace tact::narrowphase {

struct MeshDistance {
  int facet_a = -1, facet_b = -1;  // the caller's numbers; of equally near ones the least of a, then of b
  double distance = 0.0;           // zero exactly if they meet; where a vertex is nearest the exact one, rounded once
  std::array<double, 3> weight_a{}, weight_b{};  // of the facets' corners at the nearest places
};

/// The distance of two meshes, if it is at most `within`, metres.
std::optional<MeshDistance> least_distance(const ClusteredMesh& a, const ClusteredMesh& b, double within);

/// The same of a mesh and a half-space, which is facet 0 of b and solid.
std::optional<MeshDistance> least_distance(const ClusteredMesh& mesh, const HalfSpace& space, double within);

}  // namespace tact::narrowphase

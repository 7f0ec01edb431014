// The parts of a mesh that its facets connect.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/mesh/features.h"

namespace tact::narrowphase {

/// Of each part connected by facets the vertex, by the mesh's number, that has the least number of the caller's,
/// however facets are grouped. In the order of the caller's numbers. `edges`: those of the facets, each at least once,
/// by the mesh's numbers.
std::vector<int> one_of_each_part(const ClusteredMesh& mesh, std::span<const EdgeVertices> edges);
/// The same from the facets, which takes longer.
std::vector<int> one_of_each_part(const ClusteredMesh& mesh);

}  // namespace tact::narrowphase

// Whether two meshes are the same but for where they are: what depends on facets alone is then the same for both.
#pragma once

#include <cstdint>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// Whether both have the same vertices, facets, edges and points, by the caller's numbers, in the same clusters.
bool same_topology(const ClusteredMesh& a, const ClusteredMesh& b);

/// Of meshes for which same_topology() holds it is the same.
std::uint64_t topology_hash(const ClusteredMesh& mesh);

}  // namespace tact::narrowphase

// A mesh in the caller's numbers again.
#pragma once

#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// Three source vertices for each source facet.
std::vector<int> source_facets(const ClusteredMesh& mesh);
/// Three coordinates for each source vertex, of a placement of the mesh; zero where no facet uses it.
std::vector<double> source_positions(const ClusteredMesh& mesh, const PointArrays& points);

}  // namespace tact::narrowphase

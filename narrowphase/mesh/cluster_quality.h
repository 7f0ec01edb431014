// How well a mesh's clusters fit its facets. Clusters are made from where the facets are then; as a mesh deforms, the
// boxes of its clusters grow, and a mesh whose quality has decayed is clustered anew.
#pragma once

#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// How large the clusters are: the sum of (length + width + height)² of their boxes, in square metres.
double cluster_spread(const ClusteredMesh& mesh);

/// The spread of the facets, estimated from up to 128 of them, over the spread of the clusters: about 1.6 for a smooth
/// mesh whose clusters are new, whatever its size, and less as they decay. Infinite if the facets have no size.
double cluster_quality(const ClusteredMesh& mesh);

/// The same mesh, its clusters made from where its facets are now.
ClusteredMesh clustered_anew(const ClusteredMesh& mesh);
/// The numbers that the vertices of `mesh` have in `other`, which was clustered anew from it.
std::vector<int> vertex_numbers_in(const ClusteredMesh& other, const ClusteredMesh& mesh);

}  // namespace tact::narrowphase

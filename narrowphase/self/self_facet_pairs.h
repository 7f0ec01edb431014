// Which facets of one mesh meet that share no vertex.
#pragma once

#include <tact/facet_pair.h>

#include <span>
#include <vector>

#include "narrowphase/triangles/cluster_pairs.h"

namespace tact::narrowphase {

/// Appends the facet pairs of some cluster pairs, in no particular order, by the caller's numbers with a < b. All
/// cluster pairs whose boxes overlap together give each facet pair once. Facets meet as closed sets, decided exactly (triangle_triangle.h).
/// Facets that name a common vertex do not count; facets whose vertices have different numbers and the same place do.
void find_self_facet_pairs(const ClusteredMesh& mesh, std::span<const ClusterPair> pairs,
                           std::vector<FacetPair>& found);

}  // namespace tact::narrowphase

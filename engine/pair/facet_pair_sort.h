// Sorts facet pairs by (a, b).
#pragma once

#include <tact/facet_pair.h>

#include <span>
#include <vector>

#include "engine/base/key_sort.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact {

/// All different; the numbers of facets are below `facets_a` and `facets_b`.
void sort_facet_pairs(std::vector<FacetPair>& pairs, int facets_a, int facets_b, base::KeySorter& sorter, int threads);

/// Moves the pairs of edges and points out of sorted pairs, where any mesh has some: see narrowphase::WithoutArea.
void split_off_bare(const narrowphase::ClusteredMesh& a, const narrowphase::ClusteredMesh& b,
                    std::vector<FacetPair>& pairs, std::vector<FacetPair>& bare);
/// Both together, sorted: `pairs` if none is bare, else in `room`.
std::span<const FacetPair> with_bare(const std::vector<FacetPair>& pairs, const std::vector<FacetPair>& bare,
                                     std::vector<FacetPair>& room);

}  // namespace tact

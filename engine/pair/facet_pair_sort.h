// Sorts facet pairs by (a, b).
#pragma once

#include <tact/facet_pair.h>

#include <vector>

#include "engine/base/key_sort.h"

namespace tact {

/// All different; the numbers of facets are below `facets_a` and `facets_b`.
void sort_facet_pairs(std::vector<FacetPair>& pairs, int facets_a, int facets_b, base::KeySorter& sorter, int threads);

}  // namespace tact

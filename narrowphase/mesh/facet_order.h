// The order of a mesh's facets: neighbours stand together, and every run of kClusterSize facets is a cluster.
#pragma once

#include <span>
#include <vector>

namespace tact::narrowphase {

inline constexpr int kClusterSize = 64;  // facets in a cluster, at most

// The facets, given as 3 x F vertices, each 0 <= i < vertex_count, in the order in which clusters take them. Halves are
// cut off at the median of the axis that is longest, measured in facets, at whole clusters so that all come out full,
// and within a cluster at whole groups of eight. A vertex that facets of both halves use is read for both: of a few
// thousand facets that axis is taken along which the fewest are shared, of those not much shorter than the longest, and
// then facets change sides, two at a time, while that makes fewer (after Fiduccia and Mattheyses, "A linear-time
// heuristic for improving network partitions", 1982). Depends on nothing but the input: ties break by facet number.
std::vector<int> facet_order(std::span<const double> positions, std::span<const int> facets, int vertex_count);

}  // namespace tact::narrowphase

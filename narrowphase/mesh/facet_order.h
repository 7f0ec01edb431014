// The order of a mesh's facets: neighbours stand together, and every run of kClusterSize facets is a cluster.
#pragma once

#include <span>
#include <vector>

namespace tact::narrowphase {

inline constexpr int kClusterSize = 64;  // facets in a cluster, at most

// The facets, given as 3 x F vertices, each 0 <= i < vertex_count, in the order in which clusters take them. The facets
// are halved again and again: at the median along the longest axis, measured in facets; at whole clusters, so that all
// are full; within a cluster at whole groups of eight. A vertex that facets of both halves use is read for both. So up
// to a few thousand facets are halved with care: of the axes not much shorter than the longest, the one is taken along
// which the fewest vertices are shared; then facets change sides, two at a time, while that leaves fewer (after
// Fiduccia and Mattheyses, "A linear-time heuristic for improving network partitions", 1982). The order depends on the
// input alone: ties break by facet number.
std::vector<int> facet_order(std::span<const double> positions, std::span<const int> facets, int vertex_count);

}  // namespace tact::narrowphase

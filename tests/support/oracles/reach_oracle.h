// All pairs of features within reach by a plain loop, in long doubles. It shares no code with the engine.
#pragma once

#include <tact/feature_pair.h>

#include <array>
#include <map>
#include <tuple>

#include "tests/support/mesh.h"

namespace tact::tests {

/// The features of a pair: a vertex, an edge in ascending order, or a facet in its own, without what it repeats.
using ReachKey = std::tuple<FeaturePair, std::array<int, 3>, std::array<int, 3>>;

/// Every vertex and facet, and every two edges, of two meshes that are nearer than `reach`, with their distance; two
/// facets of one vertex once.
std::map<ReachKey, long double> pairs_within_reach(const Mesh& a, const Mesh& b, double reach);

/// The same of one mesh with itself, without those that share a vertex: vertices before facets, the lesser edge first.
std::map<ReachKey, long double> own_pairs_within_reach(const Mesh& mesh, double reach);

}  // namespace tact::tests

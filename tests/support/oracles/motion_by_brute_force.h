// What meets between two placements of meshes, pair by pair: all features against all, with neither trees nor filters.
#pragma once

#include <tact/feature_pair.h>

#include <array>
#include <map>
#include <tuple>

#include "tests/support/mesh.h"

namespace tact::tests {

/// A mesh, and where its vertices go.
struct MovingMesh {
  Mesh begin;
  Eigen::Matrix3Xd end;
};

using ImpactKey = std::tuple<FeaturePair, std::array<int, 3>, std::array<int, 3>>;

/// The time of each pair of features of two meshes that come within `reach`.
std::map<ImpactKey, double> impacts_by_brute_force(const MovingMesh& a, const MovingMesh& b, double reach);
/// The same of one mesh with itself: pairs without a common vertex, the vertex or the lesser edge first. Those that are
/// no contact within `reach`, as a facet beside the place is nearer or as they are near along the edges, meet where
/// they share a point.
std::map<ImpactKey, double> self_impacts_by_brute_force(const MovingMesh& mesh, double reach);

}  // namespace tact::tests

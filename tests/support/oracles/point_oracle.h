// Contact points by a plain loop over all vertices, edges and facets, in long doubles. It shares no code with the
// engine.
#pragma once

#include <tact/feature_pair.h>

#include <array>
#include <map>
#include <tuple>

#include "tests/support/mesh.h"

namespace tact::tests {

/// The features of a contact point: as the engine names them.
using PointKey = std::tuple<FeaturePair, std::array<int, 3>, std::array<int, 3>>;

struct ExpectedPoint {
  Vec3 a, b;            // where it lies on either surface
  double gap = 0.0;     // metres
  bool certain = true;  // false: within the band around the reach or around a border, so that it may be missing
};

/// All points of two meshes that are nearer than `reach`, and those that lie in a band of `band` metres.
std::map<PointKey, ExpectedPoint> points_by_brute_force(const Mesh& a, const Mesh& b, double reach, double band);

/// The same of one mesh with itself, each pair of features once: vertices before facets, the lesser edge first.
/// Features that name a common vertex have none, nor have those that are nearer than pi/2 times `reach` along the
/// edges.
std::map<PointKey, ExpectedPoint> self_points_by_brute_force(const Mesh& mesh, double reach, double band);

/// How long the shortest way along edges is from one point to another, from and to vertices of the features that hold
/// them; -1 fills these up.
long double way_along_edges(const Mesh& mesh, const std::array<int, 3>& from, Vec3 from_point,
                            const std::array<int, 3>& to, Vec3 to_point);

}  // namespace tact::tests

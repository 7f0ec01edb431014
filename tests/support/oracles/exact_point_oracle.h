// Contact points by a plain loop over all vertices, edges and facets, in rational numbers: which of them there are by
// the rule of the manual, with nothing rounded. It shares no code with the engine.
#pragma once

#include <map>

#include "tests/support/oracles/point_oracle.h"

namespace tact::tests {

struct ExactPoint {
  double gap = 0.0;     // metres, rounded
  bool there = true;    // by the rule
  bool certain = true;  // false: within the band around the reach or around a border
};

/// All points of two meshes that are nearer than `reach`, and those that a band of `band` metres around the rule adds;
/// all are certain where the band is zero. A facet that repeats another one has no points of its own.
std::map<PointKey, ExactPoint> exact_points(const Mesh& a, const Mesh& b, double reach, double band);

}  // namespace tact::tests

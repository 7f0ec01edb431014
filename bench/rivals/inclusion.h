// Continuous collision of features as it is published, in a page: the coplanarity filter of Tang, Manocha, Tong, "Fast
// continuous collision detection using deforming non-penetration filters", 2010, then the inclusion-based bisection of
// Wang et al., "A large-scale benchmark and an inclusion-based algorithm for continuous collision detection", 2021;
// among all features whose boxes on the way overlap, found by a sweep along x.
#pragma once

#include <tact/feature_pair.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "bench/workloads/shapes.h"

namespace tact::bench {

/// A shape, and where its vertices go.
struct MovingShape {
  Shape begin;
  Eigen::Matrix3Xd end;
};

struct InclusionImpact {
  FeaturePair kind;
  std::array<int, 3> a, b;
  double time;
};

struct InclusionResult {
  std::vector<InclusionImpact> impacts;
  long candidates = 0;
};

InclusionResult find_by_inclusion(const MovingShape& a, const MovingShape& b);

}  // namespace tact::bench

// Intersection curves of the pairs that a step looked at, and of bodies with themselves.
#pragma once

#include <tact/settings.h>

#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"
#include "engine/self_record.h"
#include "narrowphase/curves/intersection_curves.h"

namespace tact {

class CurveStage {
 public:
  /// Finds the curves of every pair of `moved` whose facets meet, each into its record, after its facet pairs were
  /// found.
  void find(std::span<const MovedPair> moved, const Bodies& bodies, const Settings& settings);
  /// Those of bodies with themselves.
  void find(std::span<SelfRecord* const> selves, const Bodies& bodies, const Settings& settings);

 private:
  std::vector<narrowphase::IntersectionCurves> searches_;  // a thread each
};

}  // namespace tact

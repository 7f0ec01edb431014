// What is kept of a body that is held against itself, from step to step.
#pragma once

#include <tact/contact_point.h>
#include <tact/facet_pair.h>
#include <tact/reach_pair.h>

#include <memory>
#include <vector>

#include "engine/curve_set.h"
#include "engine/patch_set.h"
#include "narrowphase/crossing/self_crossing.h"

namespace tact {

/// Of the last step in which the body had moved.
struct SelfRecord {
  BodyId body;
  std::vector<FacetPair> facet_pairs;  ///< sorted, a < b
  std::vector<ContactPoint> points, last_points;
  std::vector<ReachPair> within_reach;
  std::vector<narrowphase::ClusterPair> may_meet, may_contact;  ///< see narrowphase::SelfClusters
  std::unique_ptr<narrowphase::SelfCrossing> crossing;          ///< made when facets meet for the first time
  PatchMemory patches;
  std::unique_ptr<CurveSet> curves;   ///< null where no facets meet
  bool touching = false;              ///< see is_touching()
  bool point_limit_reached = false;   ///< see Contact
  std::vector<FacetPair> bare_pairs;  ///< of edges and points, with each other and with facets; sorted, a < b
  bool is_renumbered = false;         ///< see PairRecord
};

inline bool any_meet(const SelfRecord& record) { return !record.facet_pairs.empty() || !record.bare_pairs.empty(); }
inline bool in_contact(const SelfRecord& record) {
  return any_meet(record) || !record.points.empty() || !record.within_reach.empty();
}

}  // namespace tact

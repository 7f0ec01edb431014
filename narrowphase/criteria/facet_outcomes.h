// What the criteria make of each facet, for people who look: the engine's own criteria asked again, facet by facet.
#pragma once

#include <span>
#include <vector>

#include "engine/base/facet_outcome.h"
#include "narrowphase/criteria/criteria.h"

namespace tact::narrowphase {

// How one body of a pair was culled: see cull_clusters() and append_facets().
struct CulledBody {
  const ClusteredMesh* mesh = nullptr;
  Criteria criteria;
  Box first_box;                         // of the other body, for clusters
  Box last_box;                          // of what is left of the other body, for facets
  const KeptClusters* kept = nullptr;    // clusters that passed
  std::span<const std::int32_t> opened;  // indices of those of them whose facets were looked at; may come again
  bool whole = false;                    // no criterion was asked of their facets: surfaces that lie on each other
};

// The outcome of each facet, in the order in which the mesh was given; FacetOutcome::kept for those that may meet
// another.
std::vector<FacetOutcome> criteria_outcomes(const CulledBody& body);

}  // namespace tact::narrowphase

// What is held against each other to find facet pairs.
#pragma once

#include <cstdint>

#include "engine/base/tuning.h"
#include "narrowphase/criteria/criteria.h"
#include "narrowphase/pairs/cluster_pair.h"

namespace tact::narrowphase {

class SurfaceHistory;

// Two bodies after the criteria. Of their cluster pairs each has indices into kept_a and kept_b.
struct ConfirmInput {
  const ClusteredMesh* a = nullptr;
  const ClusteredMesh* b = nullptr;
  Criteria criteria_a, criteria_b;
  const KeptClusters* kept_a = nullptr;
  const KeptClusters* kept_b = nullptr;
  bool as_surfaces = false;           // see surface_pairs.h; without criterion 1 and zones only
  SurfaceHistory* history = nullptr;  // of the pair, if it is kept: it has started
  const base::Tuning* tuning = &base::kTuning;
};

// What the criteria did to a kept cluster that was opened.
struct OpenedCluster {
  std::int32_t index = 0;  // into the kept clusters
  CullCounts counts;
};

}  // namespace tact::narrowphase

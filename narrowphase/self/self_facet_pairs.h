// Which facets of one mesh meet that share no vertex.
#pragma once

#include <tact/facet_pair.h>

#include <memory>
#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/pairs/cluster_pair.h"
#include "narrowphase/triangles/block_pair.h"

namespace tact::narrowphase {

/// One for each thread, its memory used again.
class SelfFacetSearch {
 public:
  SelfFacetSearch();
  ~SelfFacetSearch();
  SelfFacetSearch(SelfFacetSearch&&) noexcept;
  SelfFacetSearch& operator=(SelfFacetSearch&&) noexcept;

  /// Appends the facet pairs of some cluster pairs, in no particular order, by the caller's numbers with a < b. All
  /// cluster pairs whose boxes overlap together give each facet pair once. Facets meet as closed sets, decided exactly.
  /// Facets that name a common vertex do not count; facets whose vertices have different numbers and the same place do.
  void run(const ClusteredMesh& mesh, std::span<const ClusterPair> pairs, const base::Tuning& tuning,
           std::vector<FacetPair>& found);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace tact::narrowphase

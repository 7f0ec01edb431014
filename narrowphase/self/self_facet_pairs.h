// Which facets of one mesh meet, but for what they have in common as neighbours.
#pragma once

#include <tact/facet_pair.h>

#include <memory>
#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/pairs/cluster_pair.h"
#include "narrowphase/self/vertex_fans.h"
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
  /// Facets that name common vertices meet if they share a point beyond these and the edge between two of them: see
  /// triangles_meet_beyond(). Vertices with different numbers and the same place are not common.
  void run(const ClusteredMesh& mesh, const VertexFans& fans, std::span<const ClusterPair> pairs,
           const base::Tuning& tuning, std::vector<FacetPair>& found);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace tact::narrowphase

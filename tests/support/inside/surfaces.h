// Two bodies through the search for surfaces that lie on each other.
#pragma once

#include <cstddef>
#include <vector>

#include "narrowphase/pairs/cluster_join.h"
#include "narrowphase/triangles/confirm.h"
#include "narrowphase/triangles/surface_history.h"

namespace tact::tests {

class SurfaceSearch {
 public:
  // The facet pairs that meet, sorted; `a` takes the part of A. With a history, what is certified is not looked at.
  // The cluster pairs are cut into `ranges` ranges.
  const std::vector<FacetPair>& operator()(const narrowphase::ClusteredMesh& a, const narrowphase::ClusteredMesh& b,
                                           narrowphase::SurfaceHistory* history = nullptr, std::size_t ranges = 1);

  std::size_t cluster_pairs() const { return pairs_.size(); }
  std::size_t opened() const { return opened_; }  // clusters of A, in the last call
  const narrowphase::ConfirmCounts& counts() const { return counts_; }

 private:
  narrowphase::EmbreeDevice device_;
  narrowphase::KeptClusters kept_a_, kept_b_;
  std::vector<narrowphase::ClusterPair> pairs_;
  narrowphase::ClusterJoin join_;
  narrowphase::SurfacePairSearch search_;
  narrowphase::ConfirmCounts counts_;
  std::vector<FacetPair> found_;
  std::size_t opened_ = 0;
};

}  // namespace tact::tests

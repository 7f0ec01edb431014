// Which facets meet: cluster pairs, then facet pairs, then exact decisions on the doubles as they are.
#pragma once

#include <tact/facet_pair.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "narrowphase/cluster_forest.h"
#include "narrowphase/criteria.h"
#include "narrowphase/predicates.h"

namespace tact::narrowphase {

// Two bodies after the criteria.
struct ConfirmInput {
  const ClusteredMesh* a = nullptr;
  const ClusteredMesh* b = nullptr;
  Criteria criteria_a, criteria_b;
  const KeptClusters* kept_a = nullptr;
  const KeptClusters* kept_b = nullptr;
};

struct ConfirmCounts {
  std::int64_t facet_box_pairs = 0;
  std::int64_t triangle_tests = 0;
  PredicateCounts predicates;
};

// A cluster of A and one of B whose boxes overlap: indices into kept_a and kept_b.
struct ClusterPair {
  std::int32_t a = 0;
  std::int32_t b = 0;
};

// What the criteria did to a kept cluster that was opened.
struct OpenedCluster {
  std::int32_t index = 0;  // into the kept clusters
  CullCounts counts;
};

// Facet `i` of a block, prepared for Kernels::crossing_facets on facets that lie in the box `others`.
FacetPlane facet_plane(const FacetBlock& block, std::size_t i, const BoxBounds& others);

// Where cluster pairs come from.
enum class ClusterPairSource { automatic, loop, forest };

// The pairs of kept clusters whose boxes overlap, sorted: by a loop over boxes where they are few, by Embree's trees
// where they are many. Says whether trees were used. `pairs` is replaced, `scratch` lends its memory.
bool find_cluster_pairs(const KeptClusters& a, const KeptClusters& b, ClusterPairSource source, EmbreeDevice& device,
                        std::vector<ClusterPair>& pairs, std::vector<std::int32_t>& scratch);

// Tests the facets of cluster pairs; one for each thread, its memory reused.
class FacetPairSearch {
 public:
  // Appends the facet pairs (as source facets) that meet in pairs[begin, end), in no particular order.
  void run(const ConfirmInput& input, const std::vector<ClusterPair>& pairs, std::size_t begin, std::size_t end,
           std::vector<FacetPair>& found, ConfirmCounts& counts);

  // The clusters that the last run opened, each once.
  const std::vector<OpenedCluster>& opened_a() const { return opened_a_; }
  const std::vector<OpenedCluster>& opened_b() const { return opened_b_; }

 private:
  struct OpenCluster {
    FacetBlock block;
    int first_facet = 0;
    std::uint64_t kept = 0;
  };
  void open_a(const ConfirmInput& input, std::int32_t index);
  const OpenCluster& open_b(const ConfirmInput& input, std::int32_t index);
  void test_clusters(const ConfirmInput& input, const OpenCluster& b, const NearFacets& near_b,
                     std::vector<FacetPair>& found, ConfirmCounts& counts);
  void decide_pairs(const ConfirmInput& input, const OpenCluster& b, std::vector<FacetPair>& found,
                    ConfirmCounts& counts);

  OpenCluster a_;
  FacetPairList pairs_;                          // of a_ and a cluster of B, to be decided together
  std::vector<std::unique_ptr<OpenCluster>> b_;  // those of this run stand as in opened_b_
  std::vector<std::int32_t> slot_;               // of each kept cluster of B in b_, or -1
  std::vector<OpenedCluster> opened_a_, opened_b_;
};

}  // namespace tact::narrowphase

// Which facets of cluster pairs meet: facet pairs, then exact decisions on the doubles as they are.
#pragma once

#include <tact/facet_pair.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/tuning.h"
#include "narrowphase/criteria/criteria.h"
#include "narrowphase/triangles/block_pair.h"
#include "narrowphase/triangles/confirm_input.h"
#include "narrowphase/triangles/surface_pairs.h"

namespace tact::narrowphase {

// True if so many cluster pairs show that surfaces lie on each other. Where bodies meet in a small part, the criteria
// leave few facets of each cluster.
bool worth_as_surfaces(const ConfirmInput& input, std::size_t cluster_pairs);

// Tests the facets of cluster pairs; one for each thread, its memory reused.
//
// Of most clusters the criteria leave a few facets. So those of several clusters are packed into a block: blocks of A
// are made one after the other and held against the blocks of B that hold a cluster which one of theirs may touch.
class FacetPairSearch {
 public:
  // Takes room for most pairs at once: which thread looks at which pair is not the same in every step.
  FacetPairSearch();

  // Appends the facet pairs (as source facets) that meet in pairs[begin, end), in no particular order. The range must
  // hold all pairs of a cluster of A or none, or a facet pair may be found in two ranges.
  void run(const ConfirmInput& input, const std::vector<ClusterPair>& pairs, std::size_t begin, std::size_t end,
           std::vector<FacetPair>& found, ConfirmCounts& counts);

  // The clusters that the last run opened, each once.
  const std::vector<OpenedCluster>& opened_a() const { return as_surfaces_ ? surfaces_.opened_a() : opened_a_; }
  const std::vector<OpenedCluster>& opened_b() const { return as_surfaces_ ? surfaces_.opened_b() : opened_b_; }

 private:
  struct BlockOfB {
    KeptFacets kept;
    bool wanted = false;  // by a cluster in the block of A
  };
  // Where the facets of an opened cluster of B are.
  struct PlaceInB {
    std::int32_t block = -1;
    std::uint64_t facets = 0;
  };
  bool reaches_b(const ConfirmInput& input, std::int32_t index, const Box& box, const CellBox& cells);
  PlaceInB open_b(const ConfirmInput& input, std::int32_t index);
  void append_a(const ConfirmInput& input, std::int32_t index, std::vector<FacetPair>& found, ConfirmCounts& counts);
  void finish_block(const ConfirmInput& input, std::vector<FacetPair>& found, ConfirmCounts& counts);
  void test_blocks(const ConfirmInput& input, const KeptFacets& b, std::vector<FacetPair>& found,
                   ConfirmCounts& counts);

  Grid grid_ = {};  // over what both bodies reach
  KeptFacets a_;
  std::vector<std::int32_t> wanted_;          // blocks of B that clusters in a_ may touch
  std::vector<std::int32_t> wanted_by_next_;  // and those that the cluster does which is about to join them
  std::vector<std::unique_ptr<BlockOfB>> b_;
  std::size_t blocks_of_b_ = 0;  // in use
  std::vector<PlaceInB> place_;  // of each kept cluster of B
  BlockPair block_pair_;         // a_ and a block of B
  std::vector<OpenedCluster> opened_a_, opened_b_;
  SurfacePairSearch surfaces_;
  bool as_surfaces_ = false;  // in the last run
};

}  // namespace tact::narrowphase

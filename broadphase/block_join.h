// Finds the overlapping pairs in a tree of blocks by walking it against itself, level by level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/block_tree.h"
#include "broadphase/index_pair.h"
#include "broadphase/kernels/kernels.h"

namespace tact::broadphase {

class BlockJoin {
 public:
  explicit BlockJoin(OverlapKernel kernel = best_overlap_kernel()) : kernel_(kernel) {}

  // Every pair of boxes in `tree` that overlap, of which the tree's last update changed at least one, and whose filters
  // agree; once each, with a < b, in parts whose order and number mean nothing. `filters` may be empty: then all agree.
  // The answer is valid until the next call.
  std::span<const std::vector<IndexPair>> run(const BlockTree& tree, std::span<const Filter> filters, int threads);

 private:
  struct BlockPair {
    std::uint32_t a;
    std::uint32_t b;
  };

  template <class Visit>
  void visit_lanes(const BlockTree& tree, std::size_t level, BlockPair pair, const Visit& visit) const;
  void expand(const BlockTree& tree, std::size_t level);
  void join(const BlockTree& tree, std::size_t level, BlockPair pair, std::span<const Filter> filters,
            std::vector<IndexPair>& out) const;

  OverlapKernel kernel_;
  std::vector<BlockPair> work_;  // pairs of blocks on one level that may hold overlapping boxes
  std::vector<BlockPair> next_;
  std::vector<std::vector<IndexPair>> parts_;
};

}  // namespace tact::broadphase

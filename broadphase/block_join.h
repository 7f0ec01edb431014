// Finds the overlapping pairs in a tree of blocks by walking it against itself, level by level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/block_tree.h"
#include "broadphase/index_pair.h"
#include "broadphase/kernels/kernels.h"
#include "broadphase/pair_list.h"

namespace tact::broadphase {

class BlockJoin {
 public:
  explicit BlockJoin(const Kernels& kernels = broadphase::kernels()) : kernels_(&kernels) {}

  // The pairs of `boxes`, those of `tree`, that overlap and whose filters agree, and of which the tree's last update
  // changed at least one box. Each pair comes once, a < b. The number and the order of the lists mean nothing. If
  // `filters` is empty, all agree. The answer is valid until the next call.
  std::span<const PairList> run(const BlockTree& tree, std::span<const Box> boxes, std::span<const Filter> filters,
                                int threads);

  // How many pairs of blocks on level 0 the last run compared.
  std::size_t visits() const;
  // How many overlapping pairs the filters of the last run dropped.
  std::size_t excluded() const;

 private:
  struct Counts {
    std::size_t visits = 0;
    std::size_t excluded = 0;
  };
  void walk(const BlockTree& tree, std::span<const Box> boxes, std::span<const Filter> filters, std::size_t level,
            IndexPair blocks, PairList& out, Counts& counts) const;
  void visit(const BlockTree& tree, std::span<const Box> boxes, std::span<const Filter> filters, IndexPair blocks,
             std::uint32_t rows, PairList& out, Counts& counts) const;

  const Kernels* kernels_;
  PairList work_;  // pairs of blocks on one level that may hold overlapping boxes
  PairList next_;
  std::vector<PairList> parts_;
  std::vector<Counts> counts_;  // by part
};

}  // namespace tact::broadphase

// Which boxes overlap, carried from step to step as in sweep and prune: what moves little is not sorted again. The
// order is along all three axes: a tree of blocks of sixteen boxes, which is joined with itself. See README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/block_join.h"
#include "broadphase/block_tree.h"
#include "broadphase/index_pair.h"
#include "broadphase/pair_sort.h"
#include "engine/base/box.h"
#include "engine/base/tuning.h"

namespace tact::broadphase {

class SweepAndPrune {
 public:
  // Finds all pairs of `boxes` that overlap (closed: touching counts) and whose filters agree, sorted by (a, b). An
  // empty box overlaps nothing. `changed` lists, in any order, every index whose box or filter differs from the last
  // call, those beyond the last call's size included. The answer is valid until the next call and depends on the boxes
  // and filters alone: not on history, nor on `threads`.
  std::span<const IndexPair> update(std::span<const Box> boxes, std::span<const Filter> filters,
                                    std::span<const std::uint32_t> changed, int threads,
                                    const base::Tuning& tuning = base::kTuning);

  std::span<const IndexPair> pairs() const { return pairs_; }
  // Whether the last call changed the pairs.
  bool pairs_changed() const { return pairs_changed_; }
  // How many overlapping pairs with a changed box the filters kept out of the last answer.
  std::size_t excluded() const { return excluded_; }

  // Whether what is kept between calls agrees with `boxes`, those of the last call. For tests.
  bool validate(std::span<const Box> boxes) const { return !tree_is_current_ || tree_.validate(boxes); }

 private:
  std::size_t mark(std::span<const Filter> filters, std::span<const std::uint32_t> changed);
  std::span<const IndexPair> compare_all(std::span<const Box> boxes, std::span<const Filter> filters);
  std::span<const IndexPair> join_changed(std::span<const Box> boxes, std::span<const Filter> filters,
                                          std::span<const std::uint32_t> changed, std::size_t changed_count,
                                          int threads);
  void merge(std::span<const IndexPair> fresh, std::size_t box_count);

  BlockTree tree_;
  bool tree_is_current_ = true;  // whether it holds the boxes of the last call: not of few boxes
  BlockJoin join_;
  PairSorter sorter_;
  std::vector<IndexPair> few_;            // of few boxes, those in which one changed
  std::vector<std::uint8_t> is_changed_;  // by box
  std::vector<std::uint8_t> is_special_;  // by box: its filter is not the default one
  std::size_t special_count_ = 0;
  std::size_t box_count_ = 0;
  std::size_t excluded_ = 0;
  bool pairs_changed_ = false;
  std::vector<IndexPair> pairs_;
  std::vector<IndexPair> merged_;
};

}  // namespace tact::broadphase

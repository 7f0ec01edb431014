// A hierarchy of boxes that is kept from step to step. Level 0 holds the boxes in spatial order, sixteen to a block;
// lane l of block j on level k + 1 is the box of block 16 j + l on level k; the top level is one block. There are no
// pointers: the order is the tree.
//
// A box that moves a little changes its lane and the bounds above it. One that leaves the region of its block is taken
// out and put at the end, in a batch that is ordered by itself; batches of similar size are merged, and a merge with
// the first one is a fresh start (the logarithmic method of Bentley and Saxe, 1980). So no block grows with history.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/block.h"
#include "broadphase/kernels/kernels.h"
#include "broadphase/spatial_order.h"

namespace tact::broadphase {

class BlockTree {
 public:
  explicit BlockTree(const Kernels& kernels = broadphase::kernels()) : kernels_(&kernels) {}

  // Takes over the boxes whose index is in `changed` or is new. `is_changed` has a byte for each box, nonzero for
  // these. Boxes with indices past the end of `boxes` are taken out.
  void update(std::span<const Box> boxes, std::span<const std::uint32_t> changed,
              std::span<const std::uint8_t> is_changed, int threads);

  // Tells the tree what it cost to find the pairs of the last update, in pairs of blocks. The excess over the first
  // such cost since the order was made is added up. When the sum reaches the cost of making an order, the order is made
  // anew: in the worst case twice the cost of an order made at the best moments.
  void note_cost(std::size_t block_pairs, std::size_t changed_count);

  std::size_t level_count() const { return level_count_; }
  std::size_t block_count(std::size_t level) const { return levels_[level].blocks.size(); }
  const Block* blocks(std::size_t level) const { return levels_[level].blocks.data(); }
  // A bit for each lane that holds or is above a box that the last update changed.
  std::uint32_t active(std::size_t level, std::size_t index) const { return levels_[level].active[index]; }
  // Whether boxes of a block on level 0 overlap if their floats do.
  bool exact(std::size_t index) const { return levels_[0].blocks[index].exact_lanes == kAllLanes; }
  // The index of the box in each lane of a block of level 0; kNone where there is none.
  const std::uint32_t* members(std::size_t block) const { return &members_[block * kLanes]; }

  // Does each box that is not empty stand in exactly one lane, unaltered, and are all bounds those of what is below?
  bool validate(std::span<const Box> boxes) const;

  static constexpr std::uint32_t kNone = 0xffffffffu;

 private:
  struct Level {
    std::vector<Block> blocks;
    std::vector<std::uint16_t> active;
  };

  struct Batch {
    std::size_t first_block = 0;
    std::size_t boxes = 0;
    std::size_t boxes_when_new = 0;
  };

  void resize(std::size_t count);
  void mark(std::span<const Box> boxes, std::span<const std::uint32_t> changed);
  void prefetch_boxes(std::span<const Box> boxes, std::size_t index) const;
  void refit_leaf(std::span<const Box> boxes, std::size_t index);
  bool worn_out() const;
  bool keep_order(std::span<const Box> boxes, std::span<const std::uint32_t> changed, int threads);
  bool most_left(std::size_t weight) const;
  void start_from_scratch(std::span<const Box> boxes);
  void collect_leavers(std::span<const Box> boxes);
  std::size_t place_arrivals(std::span<const Box> boxes, std::span<const std::uint8_t> is_changed, int threads);
  void absorb_last_batch();
  void append_batch(std::span<const Box> boxes, std::span<const std::uint8_t> is_changed, int threads);
  void resize_leaves(std::size_t count);
  void set_members(std::span<const std::uint8_t> is_changed, std::size_t index, std::span<const OrderItem> items);
  void fill_leaf(std::span<const Box> boxes, std::size_t index);
  void refit_upper_levels(std::size_t first_new, int threads);
  void refit_parent(std::size_t level, std::size_t index, bool is_new);
  bool validate_leaf_lanes(std::span<const Box> boxes) const;
  bool validate_level(std::size_t level) const;

  const Kernels* kernels_;
  Frame frame_;
  double cost_when_new_ = 0.0;  // pairs of blocks for each changed box, at the first update after the order was made
  double excess_ = 0.0;         // pairs of blocks above that, since then
  std::vector<Level> levels_ = std::vector<Level>(1);
  std::size_t level_count_ = 1;
  std::vector<std::uint32_t> members_;  // by lane of level 0; kNone where there is no box
  std::vector<FloatBox> regions_;       // by block of level 0: what its boxes may not leave
  std::vector<std::uint16_t> leavers_;  // by block of level 0: lanes whose box has just left
  std::vector<std::uint32_t> lane_of_;  // by box; kNone if it is empty
  std::vector<Batch> batches_;
  std::vector<std::uint32_t> arriving_;  // boxes that have no lane yet
  std::vector<OrderItem> items_;         // of the batch that is being ordered
};

}  // namespace tact::broadphase

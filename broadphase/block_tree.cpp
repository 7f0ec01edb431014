#include "broadphase/block_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"

namespace tact::broadphase {
namespace {

constexpr std::uint32_t kArriving = BlockTree::kNone - 1;
constexpr std::size_t kBlockGrain = 64;    // blocks that a thread takes at a time
constexpr std::size_t kPrefetch = 4;       // blocks ahead
constexpr float kRegionMargin = 1.0f / 8;  // a block may grow by this part of its largest side, in each direction
constexpr float kLoneRegionMargin = 4.0f;  // the same for a block of one box
constexpr std::size_t kMergeRatio = 2;     // a batch is merged with arrivals of more than 1 / kMergeRatio of its size
constexpr double kOrderCost = 40.0;        // what ordering costs for each block, in comparisons of two blocks: measured
constexpr std::size_t kFewChanged = 4;  // with fewer than 1 / kFewChanged of the boxes changed, the cost tells nothing
constexpr std::size_t kThin = 12;       // a batch of fewer than 1 / kThin of the boxes has a block for each box, since
                                        // sixteen of them would span many blocks of the others; break-even at 12
constexpr std::size_t kSparse = 4;  // the order is made from scratch when fewer than 1 / kSparse of its boxes are left

constexpr FloatBox kEmpty{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
constexpr FloatBox kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

void set_lane(Block& block, std::uint32_t lane, const FloatBox& box) {
  for (int axis = 0; axis < 3; ++axis) {
    block.lower[axis][lane] = box.lower[axis];
    block.upper[axis][lane] = box.upper[axis];
  }
}

FloatBox lane_box(const Block& block, std::uint32_t lane) {
  return {{block.lower[0][lane], block.lower[1][lane], block.lower[2][lane]},
          {block.upper[0][lane], block.upper[1][lane], block.upper[2][lane]}};
}

bool equal(const FloatBox& a, const FloatBox& b) {
  return std::equal(a.lower, a.lower + 3, b.lower) && std::equal(a.upper, a.upper + 3, b.upper);
}

void refit_bounds(Block& block) {
  block.bounds = kEmpty;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      block.bounds.lower[axis] = std::min(block.bounds.lower[axis], block.lower[axis][lane]);
      block.bounds.upper[axis] = std::max(block.bounds.upper[axis], block.upper[axis][lane]);
    }
  }
}

void clear_lanes(Block& block) {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) set_lane(block, lane, kEmpty);
  block.bounds = kEmpty;
  block.exact_lanes = kAllLanes;
}

// `margin` is a part of the largest side.
FloatBox widened(FloatBox box, float margin) {
  float largest = 0.0f;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, box.upper[axis] - box.lower[axis]);
  margin *= largest;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] -= margin;
    box.upper[axis] += margin;
  }
  return box;
}

// An origin in the midst of the boxes, and on so coarse a grid that round coordinates stay round.
Frame central_frame(std::span<const Box> boxes, std::span<const std::uint32_t> indices) {
  Frame frame;
  if (indices.empty()) return frame;
  std::array<double, 64> keys;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < keys.size(); ++i)
      keys[i] = boxes[indices[i * indices.size() / keys.size()]].lower[axis];
    std::sort(keys.begin(), keys.end());
    const double spread = keys[48] - keys[16] + std::numeric_limits<double>::min();
    int exponent = 0;
    const bool is_power = std::frexp(spread, &exponent) == 0.5;
    const double grid = std::ldexp(1.0, is_power ? exponent - 1 : exponent);
    const double origin = std::round(keys[32] / grid) * grid;
    frame.origin[axis] = std::isfinite(origin) ? origin : 0.0;
  }
  return frame;
}

const double* doubles_of(std::span<const Box> boxes) {
  static_assert(sizeof(Box) == 6 * sizeof(double));
  return reinterpret_cast<const double*>(boxes.data());  // which may be null
}

std::size_t blocks_for(std::size_t lanes) { return (lanes + kLanes - 1) / kLanes; }

// Calls work(lane) for each bit of `lanes`.
template <class Work>
void for_each_lane(std::uint32_t lanes, const Work& work) {
  for (; lanes != 0; lanes &= lanes - 1) work(static_cast<std::uint32_t>(std::countr_zero(lanes)));
}

}  // namespace

void BlockTree::update(std::span<const Box> boxes, std::span<const std::uint32_t> changed,
                       std::span<const std::uint8_t> is_changed, int threads) {
  for (Level& level : levels_) std::fill(level.active.begin(), level.active.end(), std::uint16_t{0});
  if (worn_out() || !keep_order(boxes, changed, threads)) start_from_scratch(boxes);
  const std::size_t first_new = place_arrivals(boxes, is_changed, threads);
  refit_upper_levels(first_new, threads);
}

// Refits the blocks and takes out the boxes that left them. Stops and returns false if so many left that placing them
// would cost as much as a new order of all boxes; a sixteenth of the blocks tells that early.
bool BlockTree::keep_order(std::span<const Box> boxes, std::span<const std::uint32_t> changed, int threads) {
  resize(boxes.size());
  mark(boxes, changed);
  const std::size_t count = levels_[0].blocks.size();
  const auto refit = [&](std::size_t index) {
    if (levels_[0].active[index] != 0) refit_leaf(boxes, index);
  };
  base::parallel_for(blocks_for(count), kBlockGrain, threads, [&](std::size_t group) { refit(group * kLanes); });
  if (most_left(kLanes)) return false;
  base::parallel_for(count, kBlockGrain, threads, [&](std::size_t index) {
    if (index % kLanes != 0) refit(index);
  });
  if (most_left(1)) return false;
  collect_leavers(boxes);
  return true;
}

// Takes out the boxes past the end.
void BlockTree::resize(std::size_t count) {
  for (std::size_t index = count; index < lane_of_.size(); ++index) {
    const std::uint32_t lane = lane_of_[index];
    if (lane == kNone) continue;
    levels_[0].active[lane / kLanes] |= static_cast<std::uint16_t>(1u << lane % kLanes);
  }
  if (count > lane_of_.size()) lane_of_.resize(count, kNone);
}

void BlockTree::mark(std::span<const Box> boxes, std::span<const std::uint32_t> changed) {
  std::uint16_t* active = levels_[0].active.data();
  for (const std::uint32_t index : changed) {
    assert(index < boxes.size());
    const std::uint32_t lane = lane_of_[index];
    if (lane < kArriving) {
      active[lane / kLanes] |= static_cast<std::uint16_t>(1u << lane % kLanes);
    } else if (lane == kNone && occupied(boxes[index])) {
      lane_of_[index] = kArriving;
      arriving_.push_back(index);
    }
  }
}

// The boxes of a block are scattered over memory.
void BlockTree::prefetch_boxes(std::span<const Box> boxes, std::size_t index) const {
  if (index >= levels_[0].blocks.size()) return;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const std::uint32_t member = members_[index * kLanes + lane];
    if (member < boxes.size()) __builtin_prefetch(&boxes[member]);
  }
}

void BlockTree::refit_leaf(std::span<const Box> boxes, std::size_t index) {
  Block& block = levels_[0].blocks[index];
  const std::uint32_t* block_members = members(index);
  prefetch_boxes(boxes, index + kPrefetch);
  // Lanes of boxes past the end are active without a box to read.
  std::uint32_t gone = 0;
  for_each_lane(levels_[0].active[index], [&](std::uint32_t lane) {
    gone |= static_cast<std::uint32_t>(block_members[lane] >= boxes.size()) << lane;
  });
  for_each_lane(gone, [&](std::uint32_t lane) { set_lane(block, lane, kEmpty); });
  block.exact_lanes |= gone;
  const std::uint32_t left = kernels_->refit_lanes(block, doubles_of(boxes), block_members,
                                                   levels_[0].active[index] & ~gone, frame_, regions_[index]);
  leavers_[index] = static_cast<std::uint16_t>(gone | left);
}

void BlockTree::note_cost(std::size_t block_pairs, std::size_t changed_count) {
  if (kFewChanged * changed_count < lane_of_.size()) return;
  const auto changed = static_cast<double>(changed_count);
  const auto cost = static_cast<double>(block_pairs);
  if (cost_when_new_ == 0.0) cost_when_new_ = cost / changed;
  excess_ += std::max(0.0, cost - cost_when_new_ * changed);
}

bool BlockTree::worn_out() const { return excess_ > kOrderCost * static_cast<double>(levels_[0].blocks.size()); }

// Whether most boxes have left, if `weight` times the known leavers have.
bool BlockTree::most_left(std::size_t weight) const {
  std::size_t leavers = 0;
  std::size_t count = 0;
  for (const std::uint16_t lanes : leavers_) {
    if (lanes != 0) leavers += static_cast<std::size_t>(std::popcount(lanes));
  }
  for (const Batch& batch : batches_) count += batch.boxes;
  return count < (1 + kMergeRatio) * weight * leavers;
}

// Takes all boxes out, in the order of their indices: reading them so is much faster than block by block.
void BlockTree::start_from_scratch(std::span<const Box> boxes) {
  batches_.clear();
  resize_leaves(0);
  arriving_.clear();
  lane_of_.assign(boxes.size(), kNone);
  for (std::uint32_t index = 0; index < boxes.size(); ++index) {
    if (occupied(boxes[index])) arriving_.push_back(index);
  }
}

void BlockTree::collect_leavers(std::span<const Box> boxes) {
  std::size_t batch = 0;
  for (std::size_t index = 0; index < leavers_.size(); ++index) {
    if (leavers_[index] == 0) continue;
    while (batch + 1 < batches_.size() && batches_[batch + 1].first_block <= index) ++batch;
    for_each_lane(leavers_[index], [&](std::uint32_t lane) {
      std::uint32_t& member = members_[index * kLanes + lane];
      lane_of_[member] = kNone;
      if (member < boxes.size() && occupied(boxes[member])) arriving_.push_back(member);
      member = kNone;
      --batches_[batch].boxes;
    });
    leavers_[index] = 0;
  }
  lane_of_.resize(boxes.size());
}

// Places the boxes that have no lane; returns the first block that is new.
std::size_t BlockTree::place_arrivals(std::span<const Box> boxes, std::span<const std::uint8_t> is_changed,
                                      int threads) {
  std::size_t count = 0;
  std::size_t room = 0;
  for (const Batch& batch : batches_) {
    count += batch.boxes;
    room += batch.boxes_when_new;
  }
  const bool sparse = count * kSparse < room;
  if (arriving_.empty() && !sparse) return levels_[0].blocks.size();
  while (!batches_.empty() && (sparse || batches_.back().boxes < kMergeRatio * arriving_.size())) absorb_last_batch();
  if (batches_.empty()) {
    frame_ = central_frame(boxes, arriving_);
    excess_ = cost_when_new_ = 0.0;
  }
  const std::size_t first_new = levels_[0].blocks.size();
  append_batch(boxes, is_changed, threads);
  return first_new;
}

void BlockTree::absorb_last_batch() {
  const std::size_t first_block = batches_.back().first_block;
  for (std::size_t lane = first_block * kLanes; lane < members_.size(); ++lane) {
    if (members_[lane] != kNone) arriving_.push_back(members_[lane]);
  }
  batches_.pop_back();
  resize_leaves(first_block);
}

void BlockTree::append_batch(std::span<const Box> boxes, std::span<const std::uint8_t> is_changed, int threads) {
  items_.resize(arriving_.size());
  base::parallel_for(items_.size(), kBlockGrain * kLanes, threads,
                     [&](std::size_t i) { items_[i] = order_item(boxes[arriving_[i]], arriving_[i], frame_); });
  order_spatially(items_, boxes, threads);
  std::size_t others = 0;
  for (const Batch& batch : batches_) others += batch.boxes;
  const std::size_t per_block = items_.size() * kThin < others ? 1 : kLanes;
  // Whole parents: the order is compact in runs of 16 blocks, counted from the front.
  const std::size_t first_block = blocks_for(levels_[0].blocks.size()) * kLanes;
  const std::size_t block_count = (items_.size() + per_block - 1) / per_block;
  resize_leaves(first_block + block_count);
  base::parallel_for(block_count, kBlockGrain, threads, [&](std::size_t i) {
    const std::size_t first = i * per_block;
    const std::span<const OrderItem> items = items_;
    set_members(is_changed, first_block + i, items.subspan(first, std::min(per_block, items.size() - first)));
  });
  base::parallel_for(block_count, kBlockGrain, threads, [&](std::size_t i) { fill_leaf(boxes, first_block + i); });
  batches_.push_back({first_block, items_.size(), items_.size()});
  arriving_.clear();
}

void BlockTree::resize_leaves(std::size_t count) {
  Level& leaves = levels_[0];
  const std::size_t old_count = leaves.blocks.size();
  leaves.blocks.resize(count);
  for (std::size_t i = old_count; i < count; ++i) clear_lanes(leaves.blocks[i]);
  leaves.active.resize(count, 0);
  members_.resize(count * kLanes, kNone);
  regions_.resize(count);
  leavers_.resize(count, 0);
}

void BlockTree::set_members(std::span<const std::uint8_t> is_changed, std::size_t index,
                            std::span<const OrderItem> items) {
  std::uint32_t active = 0;
  for (std::uint32_t lane = 0; lane < items.size(); ++lane) {
    const std::uint32_t member = items[lane].index;
    members_[index * kLanes + lane] = member;
    lane_of_[member] = static_cast<std::uint32_t>(index * kLanes + lane);
    active |= static_cast<std::uint32_t>(is_changed[member] != 0) << lane;
  }
  levels_[0].active[index] = static_cast<std::uint16_t>(active);
}

void BlockTree::fill_leaf(std::span<const Box> boxes, std::size_t index) {
  prefetch_boxes(boxes, index + kPrefetch);
  std::uint32_t lanes = 0;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    lanes |= static_cast<std::uint32_t>(members(index)[lane] != kNone) << lane;
  }
  Block& block = levels_[0].blocks[index];
  kernels_->refit_lanes(block, doubles_of(boxes), members(index), lanes, frame_, kEverywhere);
  // The bounds of a single box are always tight.
  regions_[index] = widened(block.bounds, std::has_single_bit(lanes) ? kLoneRegionMargin : kRegionMargin);
}

// Blocks of level 0 from `first_new` on are new, or gone.
void BlockTree::refit_upper_levels(std::size_t first_new, int threads) {
  std::size_t count = levels_[0].blocks.size();
  std::size_t level = 0;
  while (count > 1) {
    ++level;
    count = blocks_for(count);
    if (level == levels_.size()) levels_.emplace_back();  // kept when the tree shrinks, for its memory
    Level& parents = levels_[level];
    const std::size_t old_count = level < level_count_ ? parents.blocks.size() : 0;
    first_new = std::min(first_new / kLanes, old_count);
    parents.blocks.resize(count);
    parents.active.resize(count, 0);
    base::parallel_for(count, kBlockGrain, threads,
                       [&](std::size_t index) { refit_parent(level, index, index >= first_new); });
  }
  level_count_ = level + 1;
}

void BlockTree::refit_parent(std::size_t level, std::size_t index, bool is_new) {
  const Level& below = levels_[level - 1];
  Block& block = levels_[level].blocks[index];
  const std::size_t first = index * kLanes;
  const std::size_t children = std::min<std::size_t>(kLanes, below.blocks.size() - first);
  std::uint32_t active = 0;
  for (std::uint32_t lane = 0; lane < children; ++lane) {
    if (below.active[first + lane] == 0 && !is_new) continue;
    active |= static_cast<std::uint32_t>(below.active[first + lane] != 0) << lane;
    set_lane(block, lane, below.blocks[first + lane].bounds);
  }
  if (is_new) {
    for (auto lane = static_cast<std::uint32_t>(children); lane < kLanes; ++lane) set_lane(block, lane, kEmpty);
  }
  levels_[level].active[index] = static_cast<std::uint16_t>(active);
  if (active != 0 || is_new) refit_bounds(block);
}

bool BlockTree::validate(std::span<const Box> boxes) const {
  if (boxes.size() != lane_of_.size() || !validate_leaf_lanes(boxes)) return false;
  std::size_t counted = 0;
  for (const Batch& batch : batches_) counted += batch.boxes;
  const auto free_lanes = static_cast<std::size_t>(std::count(members_.begin(), members_.end(), kNone));
  if (counted + free_lanes != members_.size()) return false;
  for (std::size_t level = 0; level < level_count_; ++level) {
    if (!validate_level(level)) return false;
  }
  return levels_[level_count_ - 1].blocks.size() <= 1;
}

bool BlockTree::validate_leaf_lanes(std::span<const Box> boxes) const {
  std::size_t placed = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::uint32_t lane = lane_of_[i];
    if (occupied(boxes[i]) != (lane != kNone)) return false;
    if (lane == kNone) continue;
    ++placed;
    if (lane >= members_.size() || members_[lane] != i) return false;
    const Block& block = levels_[0].blocks[lane / kLanes];
    const FloatBox box = lane_box(block, lane % kLanes);
    bool exact = true;
    for (int axis = 0; axis < 3; ++axis) {
      const double origin = frame_.origin[axis];
      if (box.lower[axis] != to_float(boxes[i].lower[axis], origin)) return false;
      if (box.upper[axis] != to_float(boxes[i].upper[axis], origin)) return false;
      exact = exact && is_exact(box.lower[axis], boxes[i].lower[axis], origin) &&
              is_exact(box.upper[axis], boxes[i].upper[axis], origin);
    }
    if (exact != ((block.exact_lanes >> lane % kLanes & 1u) != 0)) return false;
  }
  return placed + static_cast<std::size_t>(std::count(members_.begin(), members_.end(), kNone)) == members_.size();
}

bool BlockTree::validate_level(std::size_t level) const {
  const std::vector<Block>& blocks = levels_[level].blocks;
  for (std::size_t index = 0; index < blocks.size(); ++index) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const FloatBox box = lane_box(blocks[index], lane);
      const std::size_t below = index * kLanes + lane;
      if (level == 0) {
        if (members_[below] == kNone && !equal(box, kEmpty)) return false;
      } else {
        const std::vector<Block>& lower = levels_[level - 1].blocks;
        if (!equal(box, below < lower.size() ? lower[below].bounds : kEmpty)) return false;
      }
    }
    Block fresh = blocks[index];
    refit_bounds(fresh);
    if (!equal(fresh.bounds, blocks[index].bounds)) return false;
  }
  return true;
}

}  // namespace tact::broadphase

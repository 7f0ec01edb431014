#include "broadphase/block_tree.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "engine/base/parallel.h"

namespace tact::broadphase {
namespace {

constexpr std::uint32_t kArriving = BlockTree::kNone - 1;
constexpr std::size_t kBlockGrain = 64;    // blocks that a thread takes at a time
constexpr std::size_t kPrefetch = 2;       // blocks ahead: their boxes are scattered over memory
constexpr double kRegionMargin = 1.0 / 8;  // a block may grow by this part of its largest side, in each direction
constexpr std::size_t kMergeRatio = 2;     // a batch is merged with arrivals of more than 1 / kMergeRatio of its size
constexpr std::size_t kSparse = 4;         // the order is made anew when fewer than 1 / kSparse of the lanes hold a box

bool occupied(const Box& box) {
  return box.lower.x <= box.upper.x && box.lower.y <= box.upper.y && box.lower.z <= box.upper.z;
}

bool encloses(const Box& outer, const Box& inner) {
  return outer.lower.x <= inner.lower.x && inner.upper.x <= outer.upper.x && outer.lower.y <= inner.lower.y &&
         inner.upper.y <= outer.upper.y && outer.lower.z <= inner.lower.z && inner.upper.z <= outer.upper.z;
}

Box widened(const Box& box) {
  const base::Vec3 size = box.upper - box.lower;
  const double margin = kRegionMargin * std::max({size.x, size.y, size.z});
  const base::Vec3 margins{margin, margin, margin};
  return {box.lower - margins, box.upper + margins};
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
  if (levels_.empty()) levels_.resize(1);
  for (Level& level : levels_) std::fill(level.active.begin(), level.active.end(), std::uint16_t{0});
  resize(boxes.size());
  mark(boxes, changed);
  refresh_leaves(boxes, threads);
  collect_leavers(boxes);
  const bool reordered = place_arrivals(boxes, is_changed, threads);
  refresh_upper_levels(reordered, threads);
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
      arriving_.push_back(order_item(boxes[index], index));
    }
  }
}

void BlockTree::refresh_leaves(std::span<const Box> boxes, int threads) {
  base::parallel_for(levels_[0].blocks.size(), kBlockGrain, threads, [&](std::size_t index) {
    if (levels_[0].active[index] != 0) refresh_leaf(boxes, index);
  });
}

void BlockTree::refresh_leaf(std::span<const Box> boxes, std::size_t index) {
  Block& block = levels_[0].blocks[index];
  const std::uint32_t* block_members = members(index);
  if ((index + kPrefetch + 1) * kLanes <= members_.size()) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t ahead = block_members[kPrefetch * kLanes + lane];
      if (ahead < boxes.size()) __builtin_prefetch(&boxes[ahead]);
    }
  }
  std::uint32_t leavers = 0;
  for_each_lane(levels_[0].active[index], [&](std::uint32_t lane) {
    const std::uint32_t member = block_members[lane];
    const bool stays = member < boxes.size() && occupied(boxes[member]) && encloses(regions_[index], boxes[member]);
    set_lane(block, lane, stays ? boxes[member] : Box{});
    leavers |= static_cast<std::uint32_t>(!stays) << lane;
  });
  leavers_[index] = static_cast<std::uint16_t>(leavers);
  refresh_bounds(block);
}

void BlockTree::collect_leavers(std::span<const Box> boxes) {
  std::size_t batch = 0;
  for (std::size_t index = 0; index < leavers_.size(); ++index) {
    if (leavers_[index] == 0) continue;
    while (batch + 1 < batches_.size() && batches_[batch + 1].first_block <= index) ++batch;
    for_each_lane(leavers_[index], [&](std::uint32_t lane) {
      std::uint32_t& member = members_[index * kLanes + lane];
      const bool stays = member < boxes.size() && occupied(boxes[member]);
      lane_of_[member] = stays ? kArriving : kNone;
      if (stays) arriving_.push_back(order_item(boxes[member], member));
      member = kNone;
      --batches_[batch].boxes;
    });
    leavers_[index] = 0;
  }
  lane_of_.resize(boxes.size());
}

bool BlockTree::place_arrivals(std::span<const Box> boxes, std::span<const std::uint8_t> is_changed, int threads) {
  std::size_t count = arriving_.size();
  for (const Batch& batch : batches_) count += batch.boxes;
  const bool sparse = count * kSparse < members_.size();
  if (arriving_.empty() && !sparse) return false;
  while (!batches_.empty() && (sparse || batches_.back().boxes < kMergeRatio * arriving_.size()))
    absorb_last_batch(boxes);
  append_batch(boxes, is_changed, threads);
  return true;
}

void BlockTree::absorb_last_batch(std::span<const Box> boxes) {
  const std::size_t first_block = batches_.back().first_block;
  for (std::size_t lane = first_block * kLanes; lane < members_.size(); ++lane) {
    if (members_[lane] != kNone) arriving_.push_back(order_item(boxes[members_[lane]], members_[lane]));
  }
  batches_.pop_back();
  resize_leaves(first_block);
}

void BlockTree::append_batch(std::span<const Box> boxes, std::span<const std::uint8_t> is_changed, int threads) {
  order_spatially(arriving_, boxes, threads);
  // Whole parents: the order is compact in runs of 16 blocks, counted from the front.
  const std::size_t first_block = blocks_for(levels_[0].blocks.size()) * kLanes;
  const std::size_t block_count = blocks_for(arriving_.size());
  resize_leaves(first_block + block_count);
  base::parallel_for(block_count, kBlockGrain, threads, [&](std::size_t i) {
    const std::size_t first = i * kLanes;
    const std::span<const OrderItem> items = arriving_;
    fill_leaf(boxes, is_changed, first_block + i,
              items.subspan(first, std::min<std::size_t>(kLanes, items.size() - first)));
  });
  batches_.push_back({first_block, arriving_.size()});
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

void BlockTree::fill_leaf(std::span<const Box> boxes, std::span<const std::uint8_t> is_changed, std::size_t index,
                          std::span<const OrderItem> items) {
  Block& block = levels_[0].blocks[index];
  std::uint32_t active = 0;
  for (std::uint32_t lane = 0; lane < items.size(); ++lane) {
    const std::uint32_t member = items[lane].index;
    set_lane(block, lane, boxes[member]);
    members_[index * kLanes + lane] = member;
    lane_of_[member] = static_cast<std::uint32_t>(index * kLanes + lane);
    active |= static_cast<std::uint32_t>(is_changed[member] != 0) << lane;
  }
  levels_[0].active[index] = static_cast<std::uint16_t>(active);
  refresh_bounds(block);
  regions_[index] = widened(bounds_box(block));
}

void BlockTree::refresh_upper_levels(bool reordered, int threads) {
  std::size_t count = levels_[0].blocks.size();
  std::size_t level = 0;
  while (count > 1) {
    ++level;
    count = blocks_for(count);
    if (level == levels_.size()) levels_.emplace_back();
    levels_[level].blocks.resize(count);
    levels_[level].active.resize(count, 0);
    base::parallel_for(count, kBlockGrain, threads,
                       [&](std::size_t index) { refresh_parent(level, index, reordered); });
  }
  levels_.resize(level + 1);
}

void BlockTree::refresh_parent(std::size_t level, std::size_t index, bool reordered) {
  const Level& below = levels_[level - 1];
  Block& block = levels_[level].blocks[index];
  const std::size_t first = index * kLanes;
  const std::size_t children = std::min<std::size_t>(kLanes, below.blocks.size() - first);
  std::uint32_t active = 0;
  for (std::uint32_t lane = 0; lane < children; ++lane) {
    if (below.active[first + lane] == 0 && !reordered) continue;
    active |= static_cast<std::uint32_t>(below.active[first + lane] != 0) << lane;
    set_lane(block, lane, bounds_box(below.blocks[first + lane]));
  }
  if (reordered) {
    for (auto lane = static_cast<std::uint32_t>(children); lane < kLanes; ++lane) set_lane(block, lane, Box{});
  }
  levels_[level].active[index] = static_cast<std::uint16_t>(active);
  if (active != 0 || reordered) refresh_bounds(block);
}

bool BlockTree::validate(std::span<const Box> boxes) const {
  if (boxes.size() != lane_of_.size()) return false;
  std::size_t placed = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::uint32_t lane = lane_of_[i];
    if (occupied(boxes[i]) != (lane != kNone)) return false;
    if (lane == kNone) continue;
    ++placed;
    if (lane >= members_.size() || members_[lane] != i) return false;
    if (lane_box(levels_[0].blocks[lane / kLanes], lane % kLanes) != boxes[i]) return false;
    if (!encloses(regions_[lane / kLanes], boxes[i])) return false;
  }
  std::size_t counted = 0;
  for (const Batch& batch : batches_) counted += batch.boxes;
  const auto free_lanes = static_cast<std::size_t>(std::count(members_.begin(), members_.end(), kNone));
  if (placed != counted || placed + free_lanes != members_.size()) return false;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    if (!validate_level(level)) return false;
  }
  return levels_.empty() || levels_.back().blocks.size() <= 1;
}

bool BlockTree::validate_level(std::size_t level) const {
  const std::vector<Block>& blocks = levels_[level].blocks;
  for (std::size_t index = 0; index < blocks.size(); ++index) {
    Box bounds;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Box box = lane_box(blocks[index], lane);
      bounds = base::merged(bounds, box);
      const std::size_t below = index * kLanes + lane;
      if (level == 0) {
        if (members_[below] == kNone && box != Box{}) return false;
      } else {
        const std::vector<Block>& lower = levels_[level - 1].blocks;
        if (box != (below < lower.size() ? bounds_box(lower[below]) : Box{})) return false;
      }
    }
    if (bounds != bounds_box(blocks[index])) return false;
  }
  return true;
}

}  // namespace tact::broadphase

// Sorts boxes so that neighbours in space are neighbours in the order: a k-d tree, whose leaves are whole blocks.
#pragma once

#include <cstdint>
#include <span>

#include "broadphase/block.h"

namespace tact::broadphase {

struct OrderItem {
  float center[3];
  std::uint32_t index;
};

OrderItem order_item(const Box& box, std::uint32_t index, const Frame& frame);

// Reorders `items` so that each run of 16^k * kLanes items, counted from the front, is compact, for every k. `boxes`
// are indexed by the items. Cost n log n for every distribution: cuts are made by rank, never by coordinate. A cut runs
// across the axis on which the boxes are smallest against their spread, so that it goes through few of them.
void order_spatially(std::span<OrderItem> items, std::span<const Box> boxes, int threads);

}  // namespace tact::broadphase

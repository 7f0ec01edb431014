#include "engine/bodies/plane_pairs.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/base/floating_point_mode.h"
#include "engine/bodies/bodies.h"

namespace tact {

using base::Box;
using broadphase::IndexPair;

bool reaches_plane(const Bodies& bodies, std::uint32_t plane, const Box& box) {
  return narrowphase::reaches(*bodies.plane(plane), box, bodies.margin(plane));
}

void PlanePairs::update(const Bodies& bodies, std::span<const Box> boxes, std::span<const std::uint32_t> changed,
                        std::span<const IndexPair> others, bool others_changed) {
  excluded_ = 0;
  const bool had_planes = !reached_.empty();
  bool own_changed = match_planes(bodies.planes());
  if (reached_.empty()) {
    own_.clear();
    pairs_ = others;
    changed_ = others_changed || had_planes;
    return;
  }
  const base::FloatingPointMode mode;
  for (Reached& reached : reached_) {
    const narrowphase::HalfSpace& space = *bodies.plane(reached.plane);
    const double margin = bodies.margin(reached.plane);
    const bool all = reached.space != space || reached.margin != margin ||
                     std::ranges::find(changed, reached.plane) != changed.end();
    reached.space = space;
    reached.margin = margin;
    reached.by_slot.resize(boxes.size(), 0);
    if (all) {
      for (std::uint32_t slot = 0; slot < boxes.size(); ++slot)
        own_changed |= look_at(bodies, reached, slot, boxes[slot]);
    } else {
      for (const std::uint32_t slot : changed) own_changed |= look_at(bodies, reached, slot, boxes[slot]);
    }
  }
  if (own_changed) list(boxes.size());
  changed_ = own_changed || others_changed;
  if (changed_ || merged_.size() != own_.size() + others.size()) {
    merged_.clear();
    std::ranges::merge(own_, others, std::back_inserter(merged_));
  }
  pairs_ = merged_;
}

// Whether planes are gone; those that are new know no body yet.
bool PlanePairs::match_planes(std::span<const std::uint32_t> planes) {
  const auto is_gone = [&](const Reached& one) { return !std::ranges::binary_search(planes, one.plane); };
  const bool any_gone = std::erase_if(reached_, is_gone) > 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (i == reached_.size() || reached_[i].plane != planes[i])
      reached_.insert(reached_.begin() + static_cast<std::ptrdiff_t>(i), {.plane = planes[i]});
  }
  return any_gone;
}

// Returns whether the pair came or went.
bool PlanePairs::look_at(const Bodies& bodies, Reached& reached, std::uint32_t slot, const Box& box) {
  bool is_pair = bodies.plane(slot) == nullptr && reaches_plane(bodies, reached.plane, box);
  if (is_pair && !broadphase::tested(bodies.filters()[reached.plane], bodies.filters()[slot])) {
    is_pair = false;
    ++excluded_;
  }
  return std::exchange(reached.by_slot[slot], std::uint8_t{is_pair}) != std::uint8_t{is_pair};
}

void PlanePairs::list(std::size_t slots) {
  own_.clear();
  for (const Reached& reached : reached_) {
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
      if (reached.by_slot[slot] != 0) own_.push_back({std::min(reached.plane, slot), std::max(reached.plane, slot)});
    }
  }
  if (reached_.size() > 1 || !std::ranges::is_sorted(own_)) std::ranges::sort(own_);
}

}  // namespace tact

#include "engine/bodies/body_tree.h"

#include <algorithm>
#include <new>
#include <numeric>

#include "engine/base/floating_point_mode.h"
#include "engine/bodies/room.h"

namespace tact {

void BodyTree::make_room(std::size_t slots) { tact::make_room(loose_, slots), tact::make_room(is_loose_, slots); }

void BodyTree::note_change(std::uint32_t slot) {
  if (is_loose_[slot] == 0) {
    is_loose_[slot] = 1;
    loose_.push_back(slot);
  }
  if (kFewLoose * loose_.size() > is_loose_.size() && is_current()) state_ = State::stale;
}

void BodyTree::expect(std::size_t queries, std::span<const base::Box> boxes) const {
  if (boxes.size() <= kFewBoxes || is_current()) return;
  if (scans_.fetch_add(queries, std::memory_order_relaxed) + queries < kScansOfUpdate) return;
  State stale = State::stale;
  if (!state_.compare_exchange_strong(stale, State::updating, std::memory_order_acquire)) return;
  scans_.store(0, std::memory_order_relaxed);
  update(boxes);
}

// On this thread alone: others have queries of their own to answer.
void BodyTree::update(std::span<const base::Box> boxes) const {
  const base::FloatingPointMode mode;
  try {
    if (tree_ == nullptr) tree_ = std::make_unique<broadphase::BlockTree>();
    tree_->update(boxes, loose_, is_loose_, 1);
  } catch (const std::bad_alloc&) {  // where memory is short queries scan
    tree_.reset();
    loose_.resize(is_loose_.size());  // there is room
    std::iota(loose_.begin(), loose_.end(), 0U);
    std::ranges::fill(is_loose_, std::uint8_t{1});
    state_.store(State::stale, std::memory_order_release);
    return;
  }
  for (const std::uint32_t slot : loose_) is_loose_[slot] = 0;
  loose_.clear();
  state_.store(State::current, std::memory_order_release);
}

}  // namespace tact

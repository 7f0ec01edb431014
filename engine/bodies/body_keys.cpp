#include "engine/bodies/body_keys.h"

#include <algorithm>

#include "engine/bodies/room.h"

namespace tact {

void BodyKeys::make_room(std::size_t slots) {
  tact::make_room(keys_, slots), tact::make_room(used_, slots), tact::make_room(stale_, slots);
  tact::make_room(added_, added_.size() + 1);
}

std::optional<std::uint32_t> BodyKeys::find(std::uint64_t key) const {
  if (key < keys_.size() && used_[key] != 0 && keys_[key] == key) return static_cast<std::uint32_t>(key);
  const auto found = given_.find(key);
  return found == given_.end() ? std::nullopt : std::optional(found->second);
}

void BodyKeys::start(std::uint32_t slot, std::uint64_t key) {
  keys_[slot] = key;
  used_[slot] = stale_[slot] = 1;
  added_.push_back(slot);
  ++version_;
}

void BodyKeys::forget(std::uint32_t slot) {
  if (keys_[slot] != slot) given_.erase(keys_[slot]);
  used_[slot] = 0;
  stale_[slot] = 1;
  ++version_;
}

// The bodies that stayed are in order still: those that came are sorted and merged with them.
void BodyKeys::update_order() {
  if (ordered_version_ == version_) return;
  if (are_slots()) {
    by_rank_.clear();
    ranks_.clear();
    return added_.clear();
  }
  const auto key_of = [&](std::uint32_t slot) { return keys_[slot]; };
  if (by_rank_.empty()) {  // no order was kept
    added_.clear();
    for (std::uint32_t slot = 0; slot < keys_.size(); ++slot) added_.push_back(slot);
  }
  std::erase_if(by_rank_, [&](std::uint32_t slot) { return stale_[slot] != 0; });
  std::erase_if(added_, [&](std::uint32_t slot) { return used_[slot] == 0; });
  std::ranges::sort(added_, {}, key_of);
  added_.erase(std::unique(added_.begin(), added_.end()), added_.end());  // slots that came, went and came
  const auto middle = static_cast<std::ptrdiff_t>(by_rank_.size());
  by_rank_.insert(by_rank_.end(), added_.begin(), added_.end());
  std::ranges::inplace_merge(by_rank_, by_rank_.begin() + middle, {}, key_of);
  ranks_.assign(keys_.size(), 0);
  for (std::uint32_t rank = 0; rank < by_rank_.size(); ++rank) ranks_[by_rank_[rank]] = rank;
  added_.clear();
  std::ranges::fill(stale_, 0);
  ordered_version_ = version_;
}

}  // namespace tact

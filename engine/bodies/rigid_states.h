// What a batch of poses reads and writes of rigid bodies, one beside the other: in the order in which the bodies were
// added, as long as none is removed.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "narrowphase/mesh/rigid_pose.h"

namespace tact {

struct alignas(64) RigidState {
  narrowphase::RigidPose pose;
  // Where the body was in the last step, if it has moved since, and whether it stands in Body::begin.
  narrowphase::Pose begin_pose = {};
  bool begin_is_placed = false;
};

class RigidStates {
 public:
  // The next take() does not fail.
  void make_room() {
    if (!free_.empty()) return;
    const std::size_t all = (blocks_.size() + 1) * kBlock;
    if (free_.capacity() < all) free_.reserve(2 * all);  // so that give_back() does not fail either
    blocks_.push_back(std::make_unique<RigidState[]>(kBlock));
    for (std::size_t i = kBlock; i-- > 0;) free_.push_back(&blocks_.back()[i]);
  }
  // It stays where it is until it is given back.
  RigidState* take() {
    RigidState* const state = free_.back();
    free_.pop_back();
    return state;
  }
  void give_back(RigidState* state) { free_.push_back(state); }

 private:
  static constexpr std::size_t kBlock = 64;

  std::vector<std::unique_ptr<RigidState[]>> blocks_;
  std::vector<RigidState*> free_;
};

}  // namespace tact

// The pose of a rigid mesh, and whether its vertices have been placed: that is put off until somebody looks at them.
#pragma once

#include <atomic>
#include <cstdint>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/pose.h"

namespace tact::narrowphase {

class RigidPose {
 public:
  /// The mesh stands where it rests: these are its vertices and their box.
  void begin(const PointArrays& rest, int vertex_count, const Box& rest_box);

  const Pose& pose() const { return pose_; }
  /// Nothing is placed any more.
  void set(const Pose& pose);

  /// A box of all vertices at some pose, found without them: that of the turned box of the rest shape, cut with that of
  /// the ball around it, which is far smaller where the mesh is round.
  Box box_at(const Pose& pose) const;

  bool is_placed() const { return state_.load(std::memory_order_acquire) == kPlaced; }
  /// Calls place() unless it was called since the pose was set. Several threads may call this: one places, the others
  /// wait until it has.
  template <class Place>
  void place_once(const Place& place) {
    if (is_placed()) return;
    std::uint8_t state = kUnplaced;
    if (state_.compare_exchange_strong(state, kPlacing, std::memory_order_acquire)) {
      place();
      state_.store(kPlaced, std::memory_order_release);
      state_.notify_all();
      return;
    }
    while (state != kPlaced) {
      state_.wait(kPlacing, std::memory_order_acquire);
      state = state_.load(std::memory_order_acquire);
    }
  }

 private:
  static constexpr std::uint8_t kUnplaced = 0, kPlacing = 1, kPlaced = 2;

  Pose pose_;
  Box rest_box_;
  Vec3 center_;          // of the rest shape's box
  double radius_ = 0.0;  // of a ball around the center that holds all vertices
  std::atomic<std::uint8_t> state_{kUnplaced};
};

}  // namespace tact::narrowphase

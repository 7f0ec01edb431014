// The rigid bodies of a world: their poses, and when their vertices are placed.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "engine/bodies/bodies.h"
#include "engine/bodies/checks.h"
#include "engine/check_coordinate.h"
#include "narrowphase/mesh/prefetch.h"
#include "narrowphase/mesh/refit.h"

namespace tact {

namespace {

using base::Box;
using base::Vec3;
using narrowphase::ClusteredMesh;
using narrowphase::Pose;

constexpr double kLargestSkew = 1e-9;                     // of a rotation: how far R R^T is from 1 in any entry
constexpr std::size_t kPosesAtATime = 256;                // a pose takes some 50 ns
constexpr std::size_t kPosesAhead = 8, kPlacedAhead = 4;  // bodies that are prefetched
constexpr std::size_t kPlacedAtATime = 4;                 // a body takes a microsecond or more

void check_rotation(const Eigen::Matrix3d& r, const std::string& name) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::not_a_rotation, quoted(name) + ": the matrix of its pose is no rotation: " + what);
  };
  for (int i = 0; i < 3; ++i) {
    for (int k = i; k < 3; ++k) {
      const double product = (r(i, 0) * r(k, 0) + r(i, 1) * r(k, 1)) + r(i, 2) * r(k, 2);
      if (std::abs(product - (i == k ? 1.0 : 0.0)) <= kLargestSkew) continue;
      refuse("rows " + std::to_string(i) + " and " + std::to_string(k) + " have the scalar product " +
             base::text_of(product) +
             "; nearest_rotation() takes what floats leave of one, and a scale belongs into the rest shape");
    }
  }
  const double determinant = r(0, 0) * (r(1, 1) * r(2, 2) - r(1, 2) * r(2, 1)) -
                             r(0, 1) * (r(1, 0) * r(2, 2) - r(1, 2) * r(2, 0)) +
                             r(0, 2) * (r(1, 0) * r(2, 1) - r(1, 1) * r(2, 0));
  if (!(determinant > 0.0)) refuse("it mirrors");
}

Pose pose_of(const PoseUpdate& update) {
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) pose.rows[i][k] = update.rotation(i, k);
    pose.translation[i] = update.translation[i];
  }
  return pose;
}

bool may_be_too_large(const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lower[axis] < -kLargestCoordinate || box.upper[axis] > kLargestCoordinate) return true;
  }
  return false;
}

// Refuses the first vertex, in the caller's order, that would stand too far away.
void check_vertices(const ClusteredMesh& mesh, const Pose& pose, const std::string& name) {
  const narrowphase::PointArrays rest = mesh.placements().before().points;
  int first = std::numeric_limits<int>::max();
  Vec3 stands;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = placed(pose, Vec3{rest.x[v], rest.y[v], rest.z[v]});
    const bool good = base::largest_coordinate(p) <= kLargestCoordinate;
    if (good || mesh.source_vertex(v) > first) continue;
    first = mesh.source_vertex(v);
    stands = p;
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(stands[axis]) > kLargestCoordinate)
      refuse_coordinate(quoted(name) + ": vertex " + std::to_string(first), axis, stands[axis]);
  }
}

}  // namespace

void Bodies::make_rigid(ClusteredMesh& mesh, RigidState& state) {
  const Box box = mesh.box();
  for (int axis = 0; axis < 3 && !box.empty(); ++axis)
    farthest_rest_ = std::max({farthest_rest_, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
  mesh.make_rigid(&state.pose);
  mesh.place();
}

void Bodies::check(const PoseUpdate& update) const {
  const Body& body = at(update.body);
  const Slot& slot = slots_[update.body.index];
  if (slot.rigid == nullptr)
    throw Error(ErrorCode::wrong_motion, quoted(body.name) + " is not rigid: it takes no pose");
  if (slot.fixed) throw Error(ErrorCode::fixed_body, quoted(body.name) + " is fixed: its pose cannot be set");
  check_pose(update);
}

void Bodies::check_pose(const PoseUpdate& update) const {
  const Body& body = in_slot(update.body.index);
  check_rotation(update.rotation, body.name);
  double farthest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::abs(update.translation[axis]);
    if (!(size <= kLargestCoordinate))
      refuse_coordinate(quoted(body.name) + ": the translation of its pose", axis, update.translation[axis]);
    farthest = std::max(farthest, size);
  }
  // A turned coordinate is less than twice the largest one at rest.
  if (farthest + 2.0 * farthest_rest_ < 0.5 * kLargestCoordinate) return;
  const Pose pose = pose_of(update);
  if (may_be_too_large(slots_[update.body.index].rigid->pose.box_at(pose))) check_vertices(body.mesh, pose, body.name);
}

bool Bodies::publish(const PoseUpdate& update) {
  const std::uint32_t index = update.body.index;
  Slot& slot = slots_[index];
  RigidState& state = *slot.rigid;
  const Pose pose = pose_of(update);
  if (pose == state.pose.pose()) return false;
  if (slot.begin == Begin::here && slot.seen) {
    state.begin_pose = state.pose.pose();
    state.begin_is_placed = false;
    slot.begin = Begin::kept;
  }
  state.pose.set(pose);
  slot.knows_box = false;
  boxes_[index] = base::grown(state.pose.box_at(pose), margins_[index]);
  kdops_.forget(index);
  return true;
}

void Bodies::set_pose(const PoseUpdate& update) {
  const base::FloatingPointMode mode;
  check(update);
  if (publish(update)) mark_moved(update.body.index);
}

void Bodies::set_poses(std::span<const PoseUpdate> updates, int threads) {
  const base::FloatingPointMode mode;
  if (packed_meshes_.is_due(*tuning_)) pack_meshes(threads);
  pose_changed_.resize(updates.size());
  base::parallel_for(updates.size(), kPosesAtATime, threads, [&](std::size_t i) {
    try {
      check(updates[i]);
    } catch (const Error& error) {
      throw Error(error.code(), "update " + std::to_string(i) + ": " + error.what());
    }
  });
  check_named_once(updates);
  const bool prefetches = !stay_in_cache();
  base::parallel_for(updates.size(), kPosesAtATime, threads, [&](std::size_t i) {
    if (prefetches) prefetch_poses(updates, i);
    pose_changed_[i] = publish(updates[i]) ? 1 : 0;
  });
  for (std::size_t i = 0; i < updates.size(); ++i) {
    if (pose_changed_[i] != 0) mark_moved(updates[i].body.index);
  }
}

// What stands some updates ahead.
void Bodies::prefetch_poses(std::span<const PoseUpdate> updates, std::size_t i) const {
  const std::size_t k = i + kPosesAhead;
  if (k >= updates.size() || updates[k].body.index >= slots_.size()) return;
  if (const RigidState* const state = slots_[updates[k].body.index].rigid) narrowphase::prefetch_lines(state, 1);
}

// A rigid body, once.
void Bodies::note_to_place(std::uint32_t index) {
  Slot& slot = slots_[index];
  if (slot.rigid == nullptr || slot.to_place) return;
  to_place_.push_back(index);
  slot.to_place = true;
}

// A call that ran out of memory may have left some.
void Bodies::forget_to_place() {
  for (const std::uint32_t index : to_place_) slots_[index].to_place = false;
  to_place_.clear();
}

// Finds what the step needs of the body besides, while it is in the cache. Returns whether it was not placed before.
bool Bodies::place_in_cache(std::uint32_t index) {
  ClusteredMesh& mesh = slots_[index].body->mesh;
  const bool was_placed = mesh.is_placed();
  mesh.place();
  if (kdops_.is_wanted(index) && kdops_.of(index) == nullptr) kdops_.find(index, mesh);
  placed_boxes_[index] = base::grown(mesh.box(), margins_[index]);
  slots_[index].knows_box = true;
  return !was_placed;
}

// To find the box of a body of 37,000 facets first, from the few clusters that reach farthest, took as long as to place
// it: 1.1 to 1.4 of the time of a step where bodies touch, 0.8 where only their turned boxes overlap.
void Bodies::place(std::span<const broadphase::IndexPair> pairs, int threads) {
  if (!any_rigid()) return;
  placed_boxes_.resize(slots_.size());
  forget_to_place();
  for (const broadphase::IndexPair& pair : pairs) {
    if (slots_[pair.a].knows_box && slots_[pair.b].knows_box) continue;
    if (excluded_.contains(pair)) continue;
    if (!slots_[pair.a].knows_box) note_to_place(pair.a);
    if (!slots_[pair.b].knows_box) note_to_place(pair.b);
  }
  std::atomic<std::int64_t> count{0};
  const bool prefetches = !stay_in_cache();
  base::parallel_for(to_place_.size(), kPlacedAtATime, threads, [&](std::size_t i) {
    if (prefetches && i + 2 * kPlacedAhead < to_place_.size()) {
      const Slot& far = slots_[to_place_[i + 2 * kPlacedAhead]];
      narrowphase::prefetch_lines(far.body.get(), 1);
      narrowphase::prefetch_lines(far.rigid, 1);
    }
    if (prefetches && i + kPlacedAhead < to_place_.size()) prefetch_place(in_slot(to_place_[i + kPlacedAhead]).mesh);
    slots_[to_place_[i]].to_place = false;
    if (place_in_cache(to_place_[i])) count.fetch_add(1, std::memory_order_relaxed);
  });
  placed_count_ += count;
}

void Bodies::place_ways(std::span<const std::uint32_t> slots, int threads) {
  forget_to_place();
  for (const std::uint32_t slot : slots) note_to_place(slot);
  base::parallel_for(to_place_.size(), kPlacedAtATime, threads, [&](std::size_t i) {
    Slot& slot = slots_[to_place_[i]];
    Body& body = *slot.body;
    slot.to_place = false;
    body.mesh.place();
    if (slot.begin == Begin::here || slot.rigid->begin_is_placed) return;
    body.begin.resize(body.mesh.placements().size());
    body.mesh.place_at(slot.rigid->begin_pose, body.begin.data());
    slot.rigid->begin_is_placed = true;
  });
}

Box Bodies::begin_box(std::uint32_t slot) const {
  const RigidState* const state = slots_[slot].rigid;
  const bool rough = state != nullptr && slots_[slot].begin != Begin::here && !state->begin_is_placed;
  return base::grown(rough ? state->pose.box_at(state->begin_pose) : begin_of(slot).box, margins_[slot]);
}

}  // namespace tact

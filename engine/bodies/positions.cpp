// The bodies of a world that move by their vertices: stage 1 of the step.
#include <algorithm>
#include <atomic>
#include <new>

#include "engine/base/parallel.h"
#include "engine/bodies/bodies.h"
#include "engine/bodies/checks.h"
#include "engine/bodies/columns.h"
#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/prefetch.h"

namespace tact {

namespace {

using narrowphase::Refit;

constexpr std::size_t kPrefetchDistance = 8;     // bodies: as far ahead as memory takes to come
constexpr std::size_t kPublishedAtATime = 1024;  // bodies, at some nanoseconds each
constexpr std::size_t kRefittedBytes = sizeof(narrowphase::ClusteredMesh);  // of a Body, its first: what stage 1 reads
// A body of so many facets is refitted by all threads: one among many, or one of a few that would not keep them busy.
constexpr int kLargeBody = 32768, kLargeOfFew = 8192;  // facets

}  // namespace

// Where memory is short the meshes stay where they are.
void Bodies::pack_meshes(int threads) try {
  std::vector<narrowphase::ClusteredMesh*> meshes;
  meshes.reserve(count_);
  for (const Slot& slot : slots_) {
    if (slot.body) meshes.push_back(&slot.body->mesh);
  }
  packed_meshes_.pack(meshes, threads);
} catch (const std::bad_alloc&) {
  packed_meshes_.put_off();
}

void Bodies::make_updates(std::size_t count) {
  if (new_kdops_.size() < count) new_kdops_.resize(count);
  if (updates_.size() < count) updates_.resize(count);
}

void Bodies::prepare(Update& update, BodyId id, const Positions& positions) {
  const Body& body = at(id);
  const Slot& slot = slots_[id.index];
  if (slot.fixed) throw Error(ErrorCode::fixed_body, quoted(body.name) + " is fixed: its positions cannot be set");
  if (slot.rigid)
    throw Error(ErrorCode::wrong_motion,
                quoted(body.name) + " is rigid: set_pose() moves it, its positions cannot be set");
  check_array(positions, body.name);
  if (positions.cols() != slot.vertex_count) {
    throw Error(ErrorCode::wrong_size, quoted(body.name) + " has " + std::to_string(slot.vertex_count) +
                                           " vertices, but " + std::to_string(positions.cols()) +
                                           " positions were given");
  }
  make_copy_room(positions, update.copy);
  update.given = &positions;
  update.body = slot.body.get();
  update.slot = id.index;
  if (slot.begin == Begin::before) update.body->begin.resize(body.mesh.placements().size());
}

// The refresh that follows writes where the positions of the last step are.
void Bodies::keep_begin(Body& body, Slot& slot) {
  body.mesh.placements().keep_before(body.begin.data());
  slot.begin = Begin::kept;
}

void Bodies::refresh(std::size_t i, int threads) {
  Update& update = updates_[i];
  narrowphase::ClusteredMesh& mesh = update.body->mesh;
  update.positions = packed(*update.given, std::span(update.copy));
  if (slots_[update.slot].begin == Begin::before) keep_begin(*update.body, slots_[update.slot]);
  update.refitted = refit(mesh, update.positions.data(),
                          {.largest = kLargestCoordinate, .threads = threads, .prefetch = !stay_in_cache()});
  const bool changed = update.refitted == Refit::changed;
  update.box = mesh.box();
  update.knows_kdop = changed && kdops_.is_wanted(update.slot) && BodyKdops::fits(mesh);
  if (update.knows_kdop) new_kdops_[i] = narrowphase::kdop_of(mesh);
  update.quality = changed && groupings_.looks_next(update.slot, mesh) ? cluster_quality(mesh) : 0.0;
}

// Takes all bodies back and says what is wrong if the positions of any cannot be taken.
void Bodies::take_back_if_bad(std::size_t count) {
  const std::span<Update> updates = std::span(updates_).first(count);
  const auto bad = std::ranges::find(updates, Refit::bad, &Update::refitted);
  if (bad == updates.end()) return;
  for (const Update& update : updates) {
    if (update.refitted == Refit::changed) undo_refit(update.body->mesh);
  }
  check_positions(bad->positions.data(), bad->positions.size() / 3, bad->body->name);
  // Good by now: another thread writes to them.
  throw Error(ErrorCode::non_finite_position, quoted(bad->body->name) + ": its positions changed while they were read");
}

void Bodies::publish(std::size_t i) {
  const Update& update = updates_[i];
  if (update.refitted != Refit::changed) return;
  const std::uint32_t slot = update.slot;
  boxes_[slot] = base::grown(update.box, margins_[slot]);
  update.knows_kdop ? kdops_.set(slot, new_kdops_[i]) : kdops_.forget(slot);
  groupings_.note_move(slot);
}

void Bodies::note_change(const Update& update) {
  if (update.refitted != Refit::changed) return;
  mark_moved(update.slot);
  Slot& slot = slots_[update.slot];
  if (slot.begin == Begin::here && slot.seen) slot.begin = Begin::before;
  if (update.quality != 0.0) groupings_.note_quality(update.slot, update.quality);
}

void Bodies::set_positions(BodyId id, const Positions& positions, int threads) {
  const base::FloatingPointMode mode;
  make_updates(1);
  prepare(updates_[0], id, positions);
  refresh(0, updates_[0].body->mesh.facet_count() >= kLargeOfFew ? threads : 1);
  take_back_if_bad(1);
  publish(0);
  note_change(updates_[0]);
}

// Large bodies come last, one after the other, each on all threads.
void Bodies::refresh_all(std::size_t count, int threads) {
  std::atomic<bool> any_large{false};
  const bool few = count < tuning_->few_items_per_thread * static_cast<std::size_t>(threads);
  const auto large = [&](std::size_t i) {
    return threads > 1 && updates_[i].body->mesh.facet_count() >= (few ? kLargeOfFew : kLargeBody);
  };
  const std::size_t grain = base::grain_of(count, threads, 16, 128);
  const bool prefetches = !stay_in_cache();
  base::parallel_for(count, grain, threads, [&](std::size_t i) {
    if (prefetches) prefetch_updates(i, grain, threads == 1 ? count : std::min(count, i - i % grain + grain), count);
    if (large(i)) {
      any_large = true;
    } else {
      refresh(i, 1);
    }
  });
  for (std::size_t i = 0; i < count && any_large; ++i) {
    if (large(i)) refresh(i, threads);
  }
}

// Asks for the memory of what comes some bodies after update i. Of the bodies from `own_end` on, which another thread
// may turn over, only where they are is read.
void Bodies::prefetch_updates(std::size_t i, std::size_t grain, std::size_t own_end, std::size_t count) const {
  const auto ask_for = [&](std::size_t k) {
    if (k < own_end && is_packed(*updates_[k].given)) prefetch_refit(updates_[k].body->mesh, updates_[k].given->data());
  };
  for (std::size_t k = 1; i % grain == 0 && k < kPrefetchDistance; ++k) ask_for(i + k);
  ask_for(i + kPrefetchDistance);
  // Small bodies are scattered.
  if (i + 2 * kPrefetchDistance < count)
    narrowphase::prefetch_lines(reinterpret_cast<const char*>(updates_[i + 2 * kPrefetchDistance].body),
                                kRefittedBytes);
}

void Bodies::set_positions(std::span<const PositionsUpdate> updates, int threads) {
  const base::FloatingPointMode mode;
  const std::size_t count = updates.size();
  if (packed_meshes_.is_due(*tuning_)) pack_meshes(threads);
  make_updates(count);
  for (std::size_t i = 0; i < count; ++i) {
    try {
      prepare(updates_[i], updates[i].body, updates[i].positions);
    } catch (const Error& error) {
      throw Error(error.code(), "update " + std::to_string(i) + ": " + error.what());
    }
  }
  check_named_once(updates);
  refresh_all(count, threads);
  take_back_if_bad(count);
  base::parallel_for(count, kPublishedAtATime, threads, [&](std::size_t i) { publish(i); });
  for (std::size_t i = 0; i < count; ++i) note_change(updates_[i]);
}

}  // namespace tact

// How the clusters of bodies keep their shape. They are grouped by where the facets are when a body is added; as it
// deforms they grow into each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/tuning.h"
#include "engine/bodies/room.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact {

// An entry a slot. A quality is what cluster_quality() gives: the smaller, the worse.
class ClusterGroupings {
  friend struct StateFields;

 public:
  explicit ClusterGroupings(const base::Tuning& tuning) : tuning_(&tuning) {}

  // The next resize() to as many slots, and what is noted of them, cannot fail.
  void make_room(std::size_t slots) { tact::make_room(entries_, slots), tact::make_room(decayed_, slots); }
  void resize(std::size_t slots) { entries_.resize(slots); }
  // Of a new body.
  void start(std::uint32_t slot, double quality) { entries_[slot] = {.quality = quality}; }
  void forget(std::uint32_t slot) { std::erase(decayed_, slot); }

  // Whether the quality of a mesh is computed when it moves next: every n-th move, of meshes with enough clusters.
  bool looks_next(std::uint32_t slot, const narrowphase::ClusteredMesh& mesh) const {
    return entries_[slot].moves + 1 == moves_to_look(entries_[slot]) && is_looked_at(mesh);
  }
  bool is_looked_at(const narrowphase::ClusteredMesh& mesh) const {
    return static_cast<std::size_t>(mesh.cluster_count()) >= tuning_->fewest_regrouped;
  }
  // Threads may note the moves of different bodies.
  void note_move(std::uint32_t slot) {
    Entry& entry = entries_[slot];
    entry.moves = static_cast<std::uint16_t>((entry.moves + 1) % moves_to_look(entry));
  }
  void note_quality(std::uint32_t slot, double quality) {
    if (entries_[slot].decayed || !has_decayed(slot, quality)) return;
    entries_[slot].decayed = true;
    decayed_.push_back(slot);
  }

  bool has_decayed(std::uint32_t slot, double quality) const {
    return tuning_->decayed * quality < entries_[slot].quality;
  }
  bool any_decayed() const { return !decayed_.empty(); }
  // Slots of bodies whose clusters have lost their shape, sorted.
  std::span<const std::uint32_t> sort_decayed() {
    std::ranges::sort(decayed_);
    return decayed_;
  }
  // It was tried to group them again, and their quality is this now. The next try comes later.
  void note_try(std::uint32_t slot, double quality) {
    entries_[slot].quality = quality;
    entries_[slot].tries = static_cast<std::uint8_t>(std::min(entries_[slot].tries + 1, kMostDoublings));
  }
  // None counts as decayed until it is looked at again.
  void clear_decayed() noexcept {
    for (const std::uint32_t slot : decayed_) {
      entries_[slot].decayed = false;
      entries_[slot].moves = 0;
    }
    decayed_.clear();
  }

 private:
  static constexpr int kMostDoublings = 8;  // of the moves until a mesh is looked at

  struct Entry {
    double quality = 0.0;     // when the clusters were made, or could not be made better
    std::uint16_t moves = 0;  // since they were last looked at
    std::uint8_t tries = 0;   // to group again: the more there were, the longer until the next look
    bool decayed = false;
  };
  int moves_to_look(const Entry& entry) const { return tuning_->moves_to_look << entry.tries; }

  const base::Tuning* tuning_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> decayed_;
};

}  // namespace tact

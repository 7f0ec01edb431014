// The k-DOPs of those bodies that a pair test needs: an entry a slot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies/room.h"
#include "narrowphase/hull/kdop.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact {

class BodyKdops {
 public:
  // To look how far the vertices of a larger body reach takes longer than it saves.
  static constexpr int kMostVertices = 4096;
  static bool fits(const narrowphase::ClusteredMesh& mesh) {
    return mesh.vertex_count() > 0 && mesh.vertex_count() <= kMostVertices;
  }

  // The next resize() to as many slots, and what is wanted of them, cannot fail.
  void make_room(std::size_t slots) {
    tact::make_room(entries_, slots), tact::make_room(known_, slots), tact::make_room(wanted_, slots);
    tact::make_room(missing_, slots);
  }
  void resize(std::size_t slots) { entries_.resize(slots), known_.resize(slots), wanted_.resize(slots); }

  // The k-DOP of a body where it is now, or null if no test needed it.
  const narrowphase::Kdop* of(std::uint32_t slot) const { return known_[slot] != 0 ? &entries_[slot] : nullptr; }
  bool is_wanted(std::uint32_t slot) const { return wanted_[slot] != 0; }

  // Whether it is found while the positions of the body are in the cache, when it moves next. Found afterwards, all of
  // them, the pile of 4,000 blobs of tact-bench rivals takes 6 % longer.
  void want(std::uint32_t slot, bool wanted) {
    if (wanted && wanted_[slot] == 0 && known_[slot] == 0) missing_.push_back(slot);
    wanted_[slot] = wanted ? 1 : 0;
  }
  // That of a new body is found and wanted.
  void start(std::uint32_t slot, const narrowphase::ClusteredMesh& mesh) {
    find(slot, mesh);
    wanted_[slot] = 1;
  }
  void find(std::uint32_t slot, const narrowphase::ClusteredMesh& mesh) {
    known_[slot] = fits(mesh) ? 1 : 0;
    if (fits(mesh)) entries_[slot] = narrowphase::kdop_of(mesh);
  }
  void set(std::uint32_t slot, const narrowphase::Kdop& kdop) {
    known_[slot] = 1;
    entries_[slot] = kdop;
  }
  // The body has moved.
  void forget(std::uint32_t slot) { known_[slot] = 0; }

  // Slots whose k-DOPs are wanted and not known; the caller finds them, and they are taken off the list.
  std::span<const std::uint32_t> missing() const { return missing_; }
  void clear_missing() { missing_.clear(); }

 private:
  std::vector<narrowphase::Kdop> entries_;
  std::vector<char> known_, wanted_;
  std::vector<std::uint32_t> missing_;
};

}  // namespace tact

// The tree in which queries look for bodies: a hierarchy of the broad phase over their boxes.
//
// Queries bring it up to date themselves, once they have scanned all boxes so often that it pays; until then they scan.
// Calls that change bodies come one at a time, and none during a query. Queries come from many threads at once: one of
// them updates the tree while the others go on scanning. So none waits for another, and none reads what is changing.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "broadphase/block_tree.h"
#include "engine/base/box.h"

namespace tact {

class BodyTree {
 public:
  // The next resize() to as many slots, and what is noted of them, cannot fail.
  void make_room(std::size_t slots);
  void resize(std::size_t slots) { is_loose_.resize(slots, 0); }
  // The box of a slot has changed, come or gone.
  void note_change(std::uint32_t slot);

  // Counts queries that are about to scan these boxes, so that it is known whether the tree pays. Any thread may call
  // this.
  void expect(std::size_t queries, std::span<const base::Box> boxes) const;

  // Whether the tree holds all boxes but the loose ones. If not, nothing below is to be read.
  bool is_current() const { return state_.load(std::memory_order_acquire) == State::current; }
  const broadphase::BlockTree& blocks() const { return *tree_; }
  // Slots that changed since; the tree has the boxes that they had.
  std::span<const std::uint32_t> loose() const { return loose_; }
  bool is_loose(std::uint32_t slot) const { return is_loose_[slot] != 0; }

 private:
  // Boxes up to which a scan takes as long as to walk down the tree: four blocks. tact-bench queries.
  static constexpr std::size_t kFewBoxes = 64;
  // An update takes about as long as so many scans: 15 ns a box, 170 where it orders them from scratch, against 1 for a
  // ray and 10 for a nearest point. tact-bench queries.
  static constexpr std::size_t kScansOfUpdate = 8;
  // With fewer than 1 / kFewLoose of the boxes loose, a query scans these besides.
  static constexpr std::size_t kFewLoose = 16;

  enum class State : std::uint8_t { stale, updating, current };

  void update(std::span<const base::Box> boxes) const;

  // Written by the query that set the state to `updating`, and by calls that change bodies.
  mutable std::unique_ptr<broadphase::BlockTree> tree_;
  mutable std::vector<std::uint32_t> loose_;
  mutable std::vector<std::uint8_t> is_loose_;  // a byte a slot
  mutable std::atomic<State> state_{State::stale};
  mutable std::atomic<std::size_t> scans_{0};  // since the tree was current
};

}  // namespace tact

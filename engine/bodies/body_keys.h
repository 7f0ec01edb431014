// The keys of bodies, and the order of bodies by key. By default a key is the body's slot: then the order is that of
// the slots, and nothing is sorted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "broadphase/index_pair.h"

namespace tact {

// An entry a slot.
class BodyKeys {
 public:
  // The next resize() to as many slots, and what is noted of them, cannot fail.
  void make_room(std::size_t slots);
  void resize(std::size_t slots) { keys_.resize(slots), used_.resize(slots, 0), stale_.resize(slots, 0); }

  std::uint64_t of(std::uint32_t slot) const { return keys_[slot]; }
  // The slot of the body with this key.
  std::optional<std::uint32_t> find(std::uint64_t key) const;
  // A body comes, of a key that no other has; after keep_given() that cannot fail. A body goes.
  void keep_given(std::uint32_t slot, std::uint64_t key) {
    if (key != slot) given_.emplace(key, slot);
  }
  void start(std::uint32_t slot, std::uint64_t key);
  void forget(std::uint32_t slot);

  // Whether the key of each body is its slot.
  bool are_slots() const { return given_.empty(); }
  // Another number when a body has come or gone.
  std::uint64_t version() const { return version_; }
  // By slot; nothing if they are the slots.
  std::span<const std::uint64_t> all() const {
    return are_slots() ? std::span<const std::uint64_t>() : std::span(keys_);
  }

  // The order of the bodies that there are: valid until one comes or goes.
  void update_order();
  std::uint32_t rank(std::uint32_t slot) const { return ranks_.empty() ? slot : ranks_[slot]; }
  std::uint32_t slot_at(std::uint32_t rank) const { return by_rank_.empty() ? rank : by_rank_[rank]; }
  // The same two, the one with the smaller key first.
  broadphase::IndexPair ordered(const broadphase::IndexPair& pair) const {
    return rank(pair.b) < rank(pair.a) ? broadphase::IndexPair{pair.b, pair.a} : pair;
  }
  broadphase::IndexPair ranks(const broadphase::IndexPair& pair) const { return {rank(pair.a), rank(pair.b)}; }

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<char> used_;
  std::unordered_map<std::uint64_t, std::uint32_t> given_;  // keys that are not the slot of their body
  std::uint64_t version_ = 0;
  std::uint64_t ordered_version_ = 0;  // of the order
  std::vector<std::uint32_t> by_rank_, ranks_;
  std::vector<std::uint32_t> added_;  // slots whose bodies came since
  std::vector<char> stale_;           // slots whose bodies came or went since
};

}  // namespace tact

// The pairs of planes and bodies whose boxes reach down to them, beside those of the sweep: a box without end would
// overlap all others, near or far.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/index_pair.h"
#include "engine/base/box.h"
#include "narrowphase/plane/half_space.h"

namespace tact {

class Bodies;

/// True if `box`, of a body with its margin, reaches a plane with its margin.
bool reaches_plane(const Bodies& bodies, std::uint32_t plane, const base::Box& box);

/// Carried from step to step: what did not change is not looked at. A world without planes costs nothing.
class PlanePairs {
 public:
  // Adds to `others`, sorted, the pairs of planes. The boxes of all slots with their margins; `changed` lists, in any
  // order, every slot whose box or filter differs from the last call. `others` stay as long as this is used.
  void update(const Bodies& bodies, std::span<const base::Box> boxes, std::span<const std::uint32_t> changed,
              std::span<const broadphase::IndexPair> others, bool others_changed);

  std::span<const broadphase::IndexPair> pairs() const { return pairs_; }
  // Whether the last call changed the pairs.
  bool pairs_changed() const { return changed_; }
  // How many with a changed box or plane the filters kept out.
  std::size_t excluded() const { return excluded_; }

 private:
  // Of a plane, by slot: whether it has a pair with that body.
  struct Reached {
    std::uint32_t plane = 0;
    narrowphase::HalfSpace space = {};  // that it was found for
    double margin = -1.0;
    std::vector<std::uint8_t> by_slot = {};
  };
  bool match_planes(std::span<const std::uint32_t> planes);
  bool look_at(const Bodies& bodies, Reached& reached, std::uint32_t slot, const base::Box& box);
  void list(std::size_t slots);

  std::vector<Reached> reached_;               // sorted by plane
  std::vector<broadphase::IndexPair> own_;     // sorted
  std::vector<broadphase::IndexPair> merged_;  // with those of the sweep
  std::span<const broadphase::IndexPair> pairs_;
  std::size_t excluded_ = 0;
  bool changed_ = false;
};

}  // namespace tact

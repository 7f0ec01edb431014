// Patches from step to step: which is which, and what became of them.
#pragma once

#include <tact/settings.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"
#include "engine/patches.h"
#include "engine/self_record.h"

namespace tact {

class PatchStage {
 public:
  /// Finds the patches of the pairs of `moved` that are in contact, each into its record.
  void find(std::span<const MovedPair> moved, const Bodies& bodies, const Settings& settings);
  /// Those of bodies with themselves.
  void find(std::span<SelfRecord* const> selves, const Bodies& bodies, const Settings& settings);

  /// Of two steps, and in this order for the pairs of a step: gives patches the ids of those that they were, or new
  /// ones, and notes what became of them.
  void name(std::span<const MovedPair> moved, std::vector<PatchEvent>& events);
  void name(std::span<SelfRecord* const> selves, std::vector<PatchEvent>& events);
  /// The last id that was given out; and from which on new ones are.
  std::uint64_t last_id() const { return last_id_; }
  void give_ids_after(std::uint64_t id) { last_id_ = id; }

 private:
  /// A patch of this step and one of the last that have vertices in common.
  struct Match {
    int shared = 0;
    int now = 0, last = 0;
  };
  void name(BodyId a, BodyId b, PatchMemory& memory, std::vector<PatchEvent>& events);
  void count_shared(const PatchMemory& memory);

  std::vector<PatchFinder> finders_;  // a thread each
  std::vector<Match> matches_;
  std::vector<int> now_is_, last_is_;  // the partner of each patch; -1: none
  std::uint64_t last_id_ = 0;
};

}  // namespace tact

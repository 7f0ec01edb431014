// Patches from step to step: which is which, and what became of them.
#pragma once

#include <tact/settings.h>

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

  /// Gives patches the ids of those that they were in the last step, or new ones, and notes what became of them.
  void name(std::span<const MovedPair> moved, const Bodies& bodies, std::vector<PatchEvent>& events);
  void name(std::span<SelfRecord* const> selves, const Bodies& bodies, std::vector<PatchEvent>& events);

 private:
  /// A patch of this step and one of the last that have vertices in common.
  struct Match {
    int shared = 0;
    int now = 0, last = 0;
  };
  /// What a patch is in the other step; -1: none.
  struct Partner {
    int is = -1;    // the patch with the same id
    int most = -1;  // the patch with which it shares most vertices
  };
  void name(BodyId a, BodyId b, const Bodies& bodies, PatchMemory& memory, std::vector<PatchEvent>& events);
  void count_shared(const PatchMemory& memory);

  std::vector<PatchFinder> finders_;  // a thread each
  std::vector<Match> matches_;
  std::vector<Partner> now_is_, last_is_;  // of each patch
};

}  // namespace tact

// Bodies that are wholly inside others.
#pragma once

#include <tact/settings.h>

#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"

namespace tact {

class ContainmentStage {
 public:
  /// Notes in the contacts of `moved` which of two bodies is inside the other, after their facet pairs were found.
  void run(std::span<const MovedPair> moved, Bodies& bodies, const Settings& settings);

 private:
  /// A body whose box is in that of a closed one which it overlaps without meeting its facets.
  struct Wanted {
    PairRecord* record = nullptr;
    std::uint32_t inner = 0, outer = 0;
    Containment containment = Containment::none;
  };

  std::vector<Wanted> wanted_;
  std::vector<std::uint32_t> slots_;  // scratch
};

}  // namespace tact

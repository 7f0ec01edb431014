// The thresholds of one world, for tests: they force a way to an answer through these.
#pragma once

#include <tact/world.h>

#include "engine/base/tuning.h"

namespace tact {

class WorldTuning {
 public:
  /// From the next call on; no answer depends on it, but for last bits of directions. Errors: wrong_order (the world
  /// was moved from).
  static void set(const World& world, const base::Tuning& tuning);
};

}  // namespace tact

// A step that failed, of a recording.
#pragma once

#include <tact/world.h>

namespace tact {

class FailedStep {
 public:
  // Takes a step as World::detect() does, and fails at its end: the next one starts from scratch. Returns what was
  // found, valid until that one. Errors: those of World::detect().
  static const Report& play(World& world);
};

}  // namespace tact

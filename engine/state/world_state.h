// A whole world as bytes: see World::save() and World::restore().
#pragma once

#include <tact/settings.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/step.h"

namespace tact {

/// Worlds in one state have the same bytes, on every machine.
std::vector<std::byte> saved_world(const Settings& settings, const Bodies& bodies, const Step& step);

/// Tells bytes that were damaged by chance.
std::uint64_t checksum_of(std::span<const std::byte> bytes);

/// A world out of bytes.
struct RestoredWorld {
  Settings settings;  ///< not checked; those of the program are as they were given
  Bodies bodies;
  Step::Restored step;
};

/// `settings` and `bodies` are those of the world that takes it over: it keeps the program's settings, and its ids.
/// Errors: bad_state, too_large.
RestoredWorld restored_world(std::span<const std::byte> bytes, const Settings& settings, const Bodies& bodies);

}  // namespace tact

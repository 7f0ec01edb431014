// Calls of every kind, made of numbers alone: two worlds in one state that get the same calls answer alike.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <vector>

namespace tact::tests {

/// Makes some calls that change the world, a function of `seed` and of what the world tells: bodies are known by their
/// external ids, as ids differ from world to world.
void change(tact::World& world, std::uint64_t seed);

/// All that a step answers, and a call of detect_motion() before it; bodies by their index.
std::vector<std::uint64_t> answers_of_step(tact::World& world);

}  // namespace tact::tests

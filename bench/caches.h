// Which level of the memory holds what a benchmark touches.
#pragma once

#include <optional>
#include <string>

#include "bench/workloads.h"

namespace tact::bench {

// The smallest cache that holds `bytes`: 1, 2, 3, or 4 for memory; none up to twice the size of a cache, of which a
// part stays in it from step to step.
std::optional<int> cache_level(double bytes);

// "L2", "memory", "between"
std::string level_name(std::optional<int> level);

// What the program has allocated.
double heap_bytes();

// The positions of one frame of all bodies.
double frame_bytes(const Workload& workload);

}  // namespace tact::bench

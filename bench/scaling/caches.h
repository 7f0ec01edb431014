// Which level of the memory holds what a benchmark touches.
#pragma once

#include <optional>
#include <string>

#include "bench/workloads/workloads.h"

namespace tact::bench {

// The smallest cache that holds `bytes`: 1, 2, 3, or 4 for memory; none up to twice the size of a cache, of which a
// part stays in it from step to step, and where no cache is known. The last cache counts as large as it was found to
// be, once in a run: it may be shared with whoever else is on the machine.
std::optional<int> cache_level(double bytes);

// The sizes that cache_level() goes by, in words.
std::string cache_line();

// "L2", "memory", "between", "unknown"
std::string level_name(std::optional<int> level);

// What the program has allocated.
double heap_bytes();

// The positions of one frame of all bodies.
double frame_bytes(const Workload& workload);

// Milliseconds for the positions of all bodies, read and written once on one thread, as a refresh must at least; the
// first `frames` in turn.
double copy_ms(const Workload& workload, int frames, double budget_ms);

}  // namespace tact::bench

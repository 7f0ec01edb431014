// Grains and ropes on a plane, ever more of them.
#pragma once

#include "bench/options.h"

namespace tact::bench {

/// Prints a table: milliseconds of a step and nanoseconds a vertex. Errors: std::runtime_error, points are missing.
int run_grains(const BenchOptions& options);

}  // namespace tact::bench

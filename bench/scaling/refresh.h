// `tact-bench refresh`: how fast new positions are taken in.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Vertices a second of World::set_positions, held against a plain sum over the same memory on the same threads.
int run_refresh(const BenchOptions& options);

}  // namespace tact::bench

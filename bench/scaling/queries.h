// Rays and nearest points to a surface that moves, through tact, Embree and FCL.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_queries(const BenchOptions& options);

}  // namespace tact::bench

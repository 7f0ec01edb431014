// What contact points cost, and what the same points cost with others' boxes.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_points(const BenchOptions& options);

}  // namespace tact::bench

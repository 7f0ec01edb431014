// tact-bench stability: failures by kind of case, which must all be zero.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Prints a row a kind; where a count is not zero also the seed of the first case and what failed. Writes stability.csv.
// Returns 1 if any count is not zero.
int run_stability(const BenchOptions& options);

}  // namespace tact::bench

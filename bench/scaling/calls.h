// What it takes to change one body of ever more.
#pragma once

#include "bench/options.h"

namespace tact::bench {

/// Prints a table: microseconds of a call for each number of bodies, and the fitted exponent. 0 is what is wanted: a
/// call costs what it changes, not what there is.
int run_calls(const BenchOptions& options);

}  // namespace tact::bench

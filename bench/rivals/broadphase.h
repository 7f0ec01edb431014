// tact-bench broadphase: boxes alone, in every kind of motion that is known to spoil one method or another.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Every rival must find the same pairs in the same steps before anything is timed. Prints a row a workload and number
// of boxes, and the exponent of growth; writes broadphase.csv, broadphase_growth.csv and a plot. Returns 1 if an answer
// was wrong.
int run_broadphase(const BenchOptions& options);

}  // namespace tact::bench

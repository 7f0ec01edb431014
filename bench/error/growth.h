// How a pair's narrow phase grows with its facets, and how many iterations a carried direction takes.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Stages 3 to 5 of one pair of bodies of 1e3 to 1e6 facets in coherent motion, against one scan of all vertices. Prints
// a table with fitted exponents; writes growth.csv and a plot.
void print_growth(const BenchOptions& options);

// The shifted calls of GJK that carried directions took, as a histogram a workload; writes iterations.csv. Returns the
// number of workloads in which their mean is above what is promised.
int print_iterations(const BenchOptions& options);

}  // namespace tact::bench

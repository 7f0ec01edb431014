// How many of the facet pairs that meet each level finds, by kind of body.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Prints a row a kind and writes recall.csv. Returns the number of kinds in which `exact` misses a pair or finds a
// wrong one, or `paper` finds a wrong one.
int print_recall(const BenchOptions& options);

}  // namespace tact::bench

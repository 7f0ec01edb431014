// tact-bench predicates: what a triangle test costs, and how often the exact path runs.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Prints a row a kind of facet pair: time a pair of tact's exact test, of CGAL's and of FCL's, and how many FCL's gets
// wrong. Writes predicates.csv. All answers are held against CGAL's before they are timed; returns 1 if one of tact's
// is wrong.
int run_predicates(const BenchOptions& options);

}  // namespace tact::bench

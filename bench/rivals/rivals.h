// `tact-bench rivals`: the same frames through tact and through the libraries that do the same work.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// All must find the same pairs of facets in the same frames before anything is timed; 1 if one that can does not.
int run_rivals(const BenchOptions& options);

}  // namespace tact::bench

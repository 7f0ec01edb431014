// `tact-bench clusters`: pairs of clusters by a plain loop and by Embree's trees, and where the one becomes faster.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_clusters(const BenchOptions& options);

}  // namespace tact::bench

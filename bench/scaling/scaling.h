// `tact-bench scaling`: how the time of a step grows.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Strong and weak scaling over threads, growth with bodies and with facets with fitted exponents, and the slowest of
// many steps.
int run_scaling(const BenchOptions& options);

}  // namespace tact::bench

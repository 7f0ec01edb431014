// `tact-bench stages`: what each stage of a step costs, in every level of the cache.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_stages(const BenchOptions& options);

}  // namespace tact::bench

// `tact-bench idle`: what a step costs in which little or nothing moved.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_idle(const BenchOptions& options);

}  // namespace tact::bench

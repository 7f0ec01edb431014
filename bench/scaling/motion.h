// What meets between two steps.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_motion(const BenchOptions& options);

}  // namespace tact::bench

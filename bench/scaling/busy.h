// Steps beside other programs that keep the processor busy.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_busy(const BenchOptions& options);

}  // namespace tact::bench

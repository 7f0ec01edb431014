// What worlds over many ranks send and hold, as the ranks become more.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_mpi(const BenchOptions& options);

}  // namespace tact::bench

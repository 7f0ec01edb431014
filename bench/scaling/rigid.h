// Rigid bodies moved by poses, against the same bodies moved by their vertices.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_rigid(const BenchOptions& options);

}  // namespace tact::bench

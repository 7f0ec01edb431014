// What a step costs a solver that asks in small substeps, with margins, points and self-contact.
#pragma once

#include "bench/options.h"

namespace tact::bench {

int run_solver(const BenchOptions& options);

}  // namespace tact::bench

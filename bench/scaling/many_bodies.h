// Nearest points of very many small bodies, through tact and by a loop over their boxes.
#pragma once

#include "bench/options.h"

namespace tact::bench {

/// Compares the answers, then prints a table. Errors: std::runtime_error, an answer is another.
void measure_many_bodies(const BenchOptions& options);

}  // namespace tact::bench

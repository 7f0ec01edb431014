// Bodies against themselves, through tact and others.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Throws std::runtime_error where a library that should find every pair finds another set than tact.
int run_self(const BenchOptions& options);

}  // namespace tact::bench

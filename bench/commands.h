// The benchmarks that `tact-bench NAME` runs.
#pragma once

#include <vector>

#include "bench/options.h"

namespace tact::bench {

struct Command {
  const char* name = "";
  const char* description = "";  // a line
  // Prints its tables and writes files to options.out. The exit status: 0 done, 1 an answer was wrong.
  int (*run)(const BenchOptions& options) = nullptr;
  bool has_workloads = false;  // BenchOptions::plays() chooses among them
};

// In the order in which they are listed.
std::vector<Command> commands();

}  // namespace tact::bench

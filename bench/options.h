// What every benchmark is told on the command line.
#pragma once

#include <filesystem>
#include <string>

namespace tact::bench {

struct BenchOptions {
  bool quick = false;              // a short run that exercises everything and measures little: under 20 s
  int threads = 0;                 // the most threads to measure with; 0: as many as OpenMP would use
  std::filesystem::path out = {};  // folder for tables and plots, which exists; empty: none are written
  std::string only = {};           // only workloads whose name holds this text, see Command::has_workloads
};

}  // namespace tact::bench

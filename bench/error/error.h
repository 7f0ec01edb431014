// tact-bench error: run time against error, of tact at every level and setting and of the libraries that answer the
// same queries.
#pragma once

#include "bench/options.h"

namespace tact::bench {

// Prints a table a row, and where a rival is as accurate as tact and faster. Writes error.csv, error_hulls.{png,svg},
// error_meshes.{png,svg} and recall.csv. All answers are judged before they are timed; returns 1 if one of tact's is
// wrong.
int run_error(const BenchOptions& options);

}  // namespace tact::bench

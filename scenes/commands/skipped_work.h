// The ledger of a run: what the engine did not do, why, and what it would have taken.
//
// What was not done was not measured: a figure is the number of things skipped times what a thing of that kind took on
// average where it was done, in the same run. Where none was done, or its time is not measured alone, there is no
// figure.
#pragma once

#include <tact/settings.h>
#include <tact/statistics.h>

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace tact::scenes {

struct SkippedWork {
  std::string what;
  std::int64_t count = 0;
  std::string why;
  // What one would have taken, and of which work that is the mean.
  std::optional<double> ms_each;
  std::string measured_on;

  std::optional<double> ms() const {
    return ms_each ? std::optional(*ms_each * static_cast<double>(count)) : std::nullopt;
  }
};

// What the steps that `sums` adds up skipped, in the order of the stages; without what they did not skip.
std::vector<SkippedWork> skipped_work(const StepStats& sums, const Settings& settings);

// Prints it, a step on average.
void print_skipped_work(std::ostream& out, const StepStats& sums, int steps, const Settings& settings);

}  // namespace tact::scenes

#include "bench/idle.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/measure.h"
#include "bench/table.h"
#include "bench/tact_runner.h"
#include "bench/workloads.h"

namespace tact::bench {
namespace {

// Microseconds of a step in which nothing is set: many in a row, as one is shorter than the clock's grain.
double idle_step_us(TactRunner& runner) {
  constexpr int kSteps = 2000;
  std::vector<double> times;
  for (int k = 0; k < 20; ++k) {
    const double start = wall_ms();
    for (int step = 0; step < kSteps; ++step) runner.step_idle();
    times.push_back((wall_ms() - start) / kSteps);
  }
  return 1e3 * *std::min_element(times.begin(), times.end());
}

struct Moving {
  double us = 0.0;
  double candidate_pairs = 0.0;
  double kept_pairs = 0.0;
  double parted_pairs = 0.0;
};

// A step in which `count` bodies get new positions.
Moving moving_step(TactRunner& runner, const Workload& workload, std::size_t count, int threads, double budget_ms) {
  std::vector<double> times;
  Moving result;
  const double start = wall_ms();
  double expected_ms = 0.0;
  for (int k = 0; k < 10 || wall_ms() - start < budget_ms; ++k) {
    times.push_back(time_ms(threads, expected_ms, [&] {
      const StepStats& stats = runner.step_few(k % workload.frames, count).stats();
      result.candidate_pairs = static_cast<double>(stats.candidate_pairs);
      result.kept_pairs = static_cast<double>(stats.kept_pairs);
      result.parted_pairs = static_cast<double>(stats.parted_pairs);
    }));
    expected_ms = times.back();
  }
  result.us = 1e3 * median(times);
  return result;
}

}  // namespace

int run_idle(const BenchOptions& options) {
  constexpr int kFrames = 6;
  const int threads = thread_count(options.threads);
  const double budget_ms = options.quick ? 20.0 : 500.0;
  fmt::print("{}\n\n", machine_line(threads));
  std::vector<int> sizes{27, 125, 1000};
  if (!options.quick) sizes = {100, 1000, 10000};
  Table table({"blobs of 320 in a pile", "threads", "bodies that move", "us a step", "candidate pairs", "kept pairs",
               "parted pairs"});
  for (const int size : sizes) {
    const Workload workload = pile(size, 4, kFrames);
    for (const int count : threads > 1 ? std::vector<int>{1, threads} : std::vector<int>{1}) {
      TactRunner runner(workload, count);
      runner.step(0);
      table.add({fmt::to_string(size), fmt::to_string(count), "none", three_digits(idle_step_us(runner)), "", "", ""});
      for (const std::size_t moving : {1, 10, 100, size}) {
        if (moving > static_cast<std::size_t>(size)) continue;
        const Moving result = moving_step(runner, workload, moving, count, budget_ms);
        table.add({fmt::to_string(size), fmt::to_string(count),
                   moving == static_cast<std::size_t>(size) ? "all" : fmt::to_string(moving), three_digits(result.us),
                   fmt::format("{:.0f}", result.candidate_pairs), fmt::format("{:.0f}", result.kept_pairs),
                   fmt::format("{:.0f}", result.parted_pairs)});
      }
    }
  }
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "idle.csv");
  return 0;
}

}  // namespace tact::bench

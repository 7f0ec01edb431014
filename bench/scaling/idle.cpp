#include "bench/scaling/idle.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/measure.h"
#include "bench/table.h"
#include "bench/tact_runner.h"
#include "bench/workloads/workloads.h"

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
  StepStats stats;  // of the last step
};

// A step in which `count` bodies get new positions.
Moving moving_step(TactRunner& runner, const Workload& workload, std::size_t count, int threads, double budget_ms) {
  std::vector<double> times;
  Moving result;
  const double start = wall_ms();
  double expected_ms = 0.0;
  for (int k = 0; k < 10 || wall_ms() - start < budget_ms; ++k) {
    times.push_back(
        time_ms(threads, expected_ms, [&] { result.stats = runner.step_few(k % workload.frames, count).stats(); }));
    expected_ms = times.back();
  }
  result.us = 1e3 * median(times);
  return result;
}

// A pile in which one thing need not be done.
struct Skip {
  const char* what;
  Workload workload;
  Settings settings;
  std::size_t moving;  // bodies
};

std::vector<Skip> skips(const Workload& pile) {
  const std::size_t all = pile.bodies.size();
  const auto changed = [&](const auto& change) {
    Workload workload = pile;
    for (std::size_t i = 0; i < all; ++i) change(workload.bodies[i], i);
    return workload;
  };
  // Turned, so that boxes overlap where hulls do not, and drawn apart from its middle.
  Eigen::Matrix3d turn;
  turn << 0.6, -0.64, 0.48, 0.8, 0.48, -0.36, 0.0, 0.6, 0.8;
  const Workload apart = changed([&](WorkloadBody& body, std::size_t) {
    const Eigen::Vector3d center = body.frames[0].rowwise().mean();
    for (Eigen::Matrix3Xd& frame : body.frames) frame = turn * (frame.colwise() + 0.08 * center);
  });
  const Settings one{.threads = 1};
  Settings hulls = one, zones = one, patches = one;
  hulls.accuracy = Accuracy::hulls;
  zones.outputs.zones = true;
  patches.outputs.patches = true;
  return {
      {"nothing", pile, one, all},
      {"bodies at rest: nine in ten", pile, one, all / 10},
      {"fixed bodies: every other", changed([](WorkloadBody& body, std::size_t i) {
         if (i % 2 == 1) body.frames.resize(1);
       }),
       one, all},
      {"pairs that layers exclude: all", changed([](WorkloadBody& body, std::size_t) { body.mask = 0; }), one, all},
      {"bodies that are apart: all", apart, one, all},
      {"facets: hulls only", pile, hulls, all},
      {"no skip, but zones requested", pile, zones, all},
      {"no skip, but patches requested", pile, patches, all},
  };
}

struct Skipped {
  Table table;
  BarChart chart;
};

// What skipping is worth, one reason at a time.
Skipped measure_skips(bool quick, double budget_ms) {
  constexpr int kFrames = 6;
  const int size = quick ? 64 : 1000;
  const std::string pile_name = fmt::format("a pile of {} blobs of 320", size);
  Skipped skipped{Table({"skipped, of " + pile_name, "us a step", "vertices read", "excluded pairs", "kept pairs",
                         "separated pairs", "still separated", "contacts", "clusters dropped", "facets kept"}),
                  BarChart{.title = "what skipping is worth in " + pile_name, .unit = "us", .bars = {"a step"}}};
  for (const Skip& skip : skips(pile(size, 4, kFrames))) {
    TactRunner runner(skip.workload, skip.settings);
    runner.step(0);
    const auto [us, s] = moving_step(runner, skip.workload, skip.moving, 1, budget_ms);
    skipped.chart.groups.push_back({skip.what, {us}});
    skipped.table.add({skip.what, three_digits(us), fmt::to_string(s.moved_vertices), fmt::to_string(s.excluded_pairs),
                       fmt::to_string(s.kept_pairs), fmt::to_string(s.kdop_separated_pairs),
                       fmt::to_string(s.still_separated_pairs), fmt::to_string(s.contacts),
                       fmt::to_string(s.clusters - s.opened_clusters), fmt::to_string(s.kept_facets)});
  }
  return skipped;
}

}  // namespace

int run_idle(const BenchOptions& options) {
  constexpr int kFrames = 6, kAll = -1;
  const int threads = thread_count(options.threads);
  const double budget_ms = options.quick ? 20.0 : 500.0;
  fmt::print("{}\n\n", machine_line(threads));
  std::vector<int> sizes{27, 125, 1000};
  if (!options.quick) sizes = {100, 1000, 10000};
  Table table({"blobs of 320 in a pile", "threads", "bodies that move", "us a step", "candidate pairs", "kept pairs",
               "separated pairs"});
  for (const int size : sizes) {
    const Workload workload = pile(size, 4, kFrames);
    for (const int count : threads > 1 ? std::vector<int>{1, threads} : std::vector<int>{1}) {
      TactRunner runner(workload, count);
      runner.step(0);
      table.add({fmt::to_string(size), fmt::to_string(count), "none", three_digits(idle_step_us(runner)), "", "", ""});
      for (const int few : {1, 10, 100, kAll}) {
        const bool all = few == kAll;
        if (!all && few >= size) continue;
        const auto moving = static_cast<std::size_t>(all ? size : few);
        const Moving result = moving_step(runner, workload, moving, count, budget_ms);
        table.add({fmt::to_string(size), fmt::to_string(count), all ? "all" : fmt::to_string(few),
                   three_digits(result.us), fmt::to_string(result.stats.candidate_pairs),
                   fmt::to_string(result.stats.kept_pairs), fmt::to_string(result.stats.kdop_separated_pairs)});
      }
    }
  }
  table.print();
  fmt::print("\n");
  const Skipped skipped = measure_skips(options.quick, budget_ms);
  skipped.table.print();
  if (!options.out.empty()) {
    table.write_csv(options.out / "idle.csv");
    skipped.table.write_csv(options.out / "skipped.csv");
    plot_bars(options.out, "skipped", skipped.chart);
  }
  return 0;
}

}  // namespace tact::bench

#include "bench/scaling/stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/scaling/caches.h"
#include "bench/table.h"
#include "bench/tact_runner.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

// Of the frames of a coherent motion two are played, back and forth: they are part of what a cache has to hold.
constexpr int kPeriod = 24, kRepeated = 2;

struct Stage {
  const char* name;
  const char* each;  // what `count` counts
  double (*ms)(const StepStats&);
  std::int64_t (*count)(const StepStats&);
  bool summed = false;  // `ms` is, over threads
};

std::int64_t vertices(const StepStats& s) { return s.moved_vertices; }
std::int64_t bodies(const StepStats& s) { return s.bodies; }
std::int64_t moved_pairs(const StepStats& s) { return s.candidate_pairs - s.kept_pairs; }
std::int64_t pairs_looked_at(const StepStats& s) { return moved_pairs(s) - s.kdop_separated_pairs; }
std::int64_t contacts(const StepStats& s) { return s.contacts; }
std::int64_t kept_facets(const StepStats& s) { return s.kept_facets; }

const std::array kStages{
    Stage{"1 refresh", "vertex", [](const StepStats& s) { return s.refresh_ms - s.regroup_ms; }, vertices},
    Stage{"2 sweep", "body", [](const StepStats& s) { return s.sweep_ms; }, bodies},
    Stage{"3 k-DOPs", "candidate pair", [](const StepStats& s) { return s.kdop_ms; }, moved_pairs},
    Stage{"3 hulls", "pair left", [](const StepStats& s) { return s.hulls_ms - s.kdop_ms; }, pairs_looked_at, true},
    Stage{"4 direction", "contact", [](const StepStats& s) { return s.direction_ms; }, contacts, true},
    Stage{"5 cull", "contact", [](const StepStats& s) { return s.cull_ms; }, contacts, true},
    Stage{"6 confirm", "kept facet", [](const StepStats& s) { return s.confirm_ms; }, kept_facets, true},
    Stage{"7 report", "contact", [](const StepStats& s) { return s.report_ms; }, contacts},
};

struct Costs {
  std::string level;  // that holds the world and its frames
  std::array<double, kStages.size()> each_ns;
  std::array<double, kStages.size()> ms;
};

Costs measure(const Workload& workload, int threads, double budget_ms) {
  const double before = heap_bytes();
  TactRunner runner(workload, threads);
  for (int k = 0; k < 2 * kRepeated; ++k) runner.step(k % kRepeated);
  Costs costs;
  costs.level = level_name(cache_level(kRepeated * frame_bytes(workload) + heap_bytes() - before));

  std::array<std::vector<double>, kStages.size()> each, ms;
  const double start = wall_ms();
  for (int k = 0; k < 8 || wall_ms() - start < budget_ms; ++k) {
    const StepStats& s = runner.step(k % kRepeated).stats();
    for (std::size_t i = 0; i < kStages.size(); ++i) {
      ms[i].push_back(kStages[i].ms(s));
      each[i].push_back(1e6 * ms[i].back() / static_cast<double>(std::max<std::int64_t>(kStages[i].count(s), 1)));
    }
  }
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    costs.each_ns[i] = median(each[i]);
    costs.ms[i] = median(ms[i]);
  }
  return costs;
}

}  // namespace

int run_stages(const BenchOptions& options) {
  const int threads = thread_count(options.threads);
  fmt::print("{}\n{}\n\n", machine_line(threads), cache_line());
  const double budget_ms = options.quick ? 50.0 : 4000.0;
  const std::vector<int> sizes = options.quick ? std::vector{8, 27} : std::vector{27, 343, 8000};
  std::vector<Costs> one;
  Costs all_threads;
  std::vector<double> copy_ns;
  std::vector<std::string> header{"stage", "each"};
  for (const int size : sizes) {
    const Workload workload = pile(size, 4, kPeriod);
    one.push_back(measure(workload, 1, budget_ms));
    copy_ns.push_back(1e6 * copy_ms(workload, kRepeated, 0.2 * budget_ms) * sizeof(Eigen::Vector3d) /
                      frame_bytes(workload));
    header.push_back(fmt::format("{} bodies, {}: ns", size, one.back().level));
    if (size == sizes.back()) all_threads = measure(workload, threads, budget_ms);
  }
  header.insert(header.end(), {"last / first", "part of the last", fmt::format("times faster on {} threads", threads)});

  Table table(header);
  double sum = 0.0;
  for (const double ms : one.back().ms) sum += ms;
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    std::vector<std::string> row{kStages[i].name, kStages[i].each};
    for (const Costs& costs : one) row.push_back(three_digits(costs.each_ns[i]));
    row.push_back(fmt::format("{:.2f}", one.back().each_ns[i] / one.front().each_ns[i]));
    row.push_back(fmt::format("{:.0f} %", 100.0 * one.back().ms[i] / sum));
    row.push_back(fmt::format("{:.2f}", one.back().ms[i] / all_threads.ms[i] * (kStages[i].summed ? threads : 1)));
    table.add(row);
  }
  std::vector<std::string> copied{"(positions copied)", "vertex"};
  for (const double ns : copy_ns) copied.push_back(three_digits(ns));
  copied.insert(copied.end(), {fmt::format("{:.2f}", copy_ns.back() / copy_ns.front()), "", ""});
  table.add(copied);
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "stages.csv");
  return 0;
}

}  // namespace tact::bench

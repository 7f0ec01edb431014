#include "bench/scaling/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/scaling/caches.h"
#include "bench/table.h"
#include "bench/tact_runner.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

constexpr int kFrames = 12;
// Of them growth is measured on two, back and forth: they are part of what a cache has to hold.
constexpr int kPlayed = 2;

// Times of `steps` steps after one round to warm up.
std::vector<double> step_times(const Workload& workload, int threads, int steps) {
  TactRunner runner(workload, threads);
  double expected_ms = 0.0;
  for (int frame = 0; frame < workload.frames; ++frame) {
    const double start = wall_ms();
    runner.step(frame);
    expected_ms = wall_ms() - start;
  }
  std::vector<double> times;
  for (int k = 0; k < steps; ++k) {
    times.push_back(time_ms(threads, expected_ms, [&] { runner.step(k % workload.frames); }));
  }
  return times;
}

std::vector<int> thread_counts(const BenchOptions& options) {
  std::vector<int> counts;
  for (int count = 1; count < thread_count(options.threads); count *= 2) counts.push_back(count);
  counts.push_back(thread_count(options.threads));
  return counts;
}

// --- Strong and weak scaling ---

void strong_scaling(const BenchOptions& options) {
  const std::vector<NamedWorkload> all = rival_workloads(options.quick ? Size::small : Size::full);
  const std::vector<int> counts = thread_counts(options);
  Table table({"strong scaling", "threads", "ms", "times faster than 1 thread"});
  BarChart chart{
      .title = "a step on several threads", .unit = "times faster than on one", .bars = thread_names(counts)};
  for (const NamedWorkload& named : all) {
    const Workload workload = named.make();
    double one = 0.0;
    chart.groups.push_back({named.name, {}});
    for (const int count : counts) {
      const double ms = median(step_times(workload, count, (options.quick ? 1 : 4) * workload.frames));
      if (count == 1) one = ms;
      table.add({named.name, fmt::to_string(count), three_digits(ms), fmt::format("{:.2f}", one / ms)});
      chart.groups.back().values.push_back(one / ms);
    }
  }
  table.print();
  if (options.out.empty()) return;
  table.write_csv(options.out / "scaling_strong.csv");
  plot_bars(options.out, "scaling_strong", chart);
}

void weak_scaling(const BenchOptions& options) {
  Table table({"weak scaling", "bodies", "threads", "ms", "efficiency"});
  BarChart chart{.title = "a column of blobs, as many for each thread", .unit = "ms", .bars = {"a step"}};
  double one = 0.0;
  for (const int count : thread_counts(options)) {
    const Workload workload = pile_column((options.quick ? 1 : 8) * count, 8, kFrames);
    const double ms = median(step_times(workload, count, 2 * kFrames));
    if (count == 1) one = ms;
    table.add({"a column of blobs", fmt::to_string(workload.bodies.size()), fmt::to_string(count), three_digits(ms),
               fmt::format("{:.2f}", one / ms)});
    chart.groups.push_back({fmt::format("{}, {} bodies", thread_names({count}).front(), workload.bodies.size()), {ms}});
  }
  table.print();
  if (options.out.empty()) return;
  table.write_csv(options.out / "scaling_weak.csv");
  plot_bars(options.out, "scaling_weak", chart);
}

// --- Growth ---

struct GrowthPoint {
  double size = 0.0;   // bodies or facets
  double bytes = 0.0;  // of the world and of the frames that are played
  double pairs = 0.0;
  double ms = 0.0;
  double copy_ms = 0.0;  // of all positions
};

GrowthPoint measure_growth(const Workload& workload, double size, double budget_ms) {
  GrowthPoint point;
  point.size = size;
  const double before = heap_bytes();
  TactRunner runner(workload, 1);
  std::vector<double> times, pairs;
  for (int k = 0; k < 2 * kPlayed; ++k)
    pairs.push_back(static_cast<double>(runner.step(k % kPlayed).stats().facet_pairs));
  point.bytes = kPlayed * frame_bytes(workload) + heap_bytes() - before;
  const double start = wall_ms();
  double expected_ms = 0.0;
  for (int k = 0; k < 2 * kPlayed || wall_ms() - start < budget_ms; ++k) {
    times.push_back(time_ms(1, expected_ms, [&] { runner.step(k % kPlayed); }));
    expected_ms = times.back();
  }
  point.pairs = median(pairs);
  point.ms = median(times);
  point.copy_ms = copy_ms(workload, kPlayed, 0.2 * budget_ms);
  return point;
}

struct Growth {
  std::string name;
  std::string unit;  // of the sizes
  std::vector<int> parameters;
  std::function<Workload(int)> make;
  std::function<double(const Workload&)> size;
};

double body_count(const Workload& workload) { return static_cast<double>(workload.bodies.size()); }
double facet_count(const Workload& workload) { return static_cast<double>(workload.facet_count()); }

std::vector<Growth> growths(bool quick) {
  const auto column = [](int height) { return pile_column(height, 2, kFrames); };
  const auto thin = [](int count) { return scattered(count, kFrames); };
  const auto pair = [](int frequency) { return large_pair(frequency, kFrames); };
  const auto drape = [](int cells) { return cloth(cells, kFrames); };
  if (quick) {
    return {{"column of blobs of 80", "bodies", {1, 2, 4}, column, body_count},
            {"two blobs", "facets", {10, 20, 40}, pair, facet_count}};
  }
  return {{"column of blobs of 80", "bodies", {8, 16, 32, 64, 128, 256, 512, 1024}, column, body_count},
          // Cubes: then the cells of the grid that tells how densely they lie are as many.
          {"blobs of 80, few touch",
           "bodies",
           {216, 512, 1000, 2197, 4096, 8000, 15625, 32768, 64000, 125000},
           thin,
           body_count},
          {"two blobs", "facets", {10, 20, 40, 80, 113, 160, 226, 320, 452}, pair, facet_count},
          {"cloth over a sphere", "facets", {40, 80, 160, 320, 453, 640, 906}, drape, facet_count}};
}

// The exponent of a time over the points of one level of cache, if there are three or more.
std::string exponent_of_level(const std::vector<GrowthPoint>& points, std::optional<int> level,
                              double GrowthPoint::*time) {
  std::vector<double> x, y;
  if (!level) return "";
  for (const GrowthPoint& point : points) {
    if (cache_level(point.bytes) != level) continue;
    x.push_back(point.size);
    y.push_back(point.*time);
  }
  return x.size() < 3 ? "" : fmt::format("{:.2f}", fitted_exponent(x, y));
}

void growth(const BenchOptions& options) {
  fmt::print("{}\n\n", cache_line());
  Table table({"growth", "size", "", "Mbyte", "fits in", "facet pairs", "ms", "us each", "exponent there", "copy ms",
               "its exponent"});
  std::string data, plots;
  for (const Growth& kind : growths(options.quick)) {
    std::vector<GrowthPoint> points;
    for (const int parameter : kind.parameters) {
      const Workload workload = kind.make(parameter);
      points.push_back(measure_growth(workload, kind.size(workload), options.quick ? 50.0 : 1000.0));
    }
    const std::string block = fmt::format("$g{}", std::count(plots.begin(), plots.end(), '$'));
    data += block + " << EOD\n";
    for (const GrowthPoint& point : points) {
      const std::optional<int> level = cache_level(point.bytes);
      table.add({kind.name, fmt::format("{:.0f}", point.size), kind.unit, three_digits(1e-6 * point.bytes),
                 level_name(level), fmt::format("{:.0f}", point.pairs), three_digits(point.ms),
                 three_digits(1e3 * point.ms / point.size), exponent_of_level(points, level, &GrowthPoint::ms),
                 three_digits(point.copy_ms), exponent_of_level(points, level, &GrowthPoint::copy_ms)});
      data += fmt::format("{:.6g} {:.6g}\n", point.size, point.ms);
    }
    data += "EOD\n";
    plots += fmt::format("{}{} with linespoints pt 7 title '{}, {}'", plots.empty() ? "" : ", ", block, kind.name,
                         kind.unit);
  }
  table.print();
  if (options.out.empty()) return;
  table.write_csv(options.out / "scaling_growth.csv");
  plot(options.out, "scaling_growth",
       data +
           "set title 'time of a step on one thread'\nset logscale xy\nset grid\nset key top left\n"
           "set xlabel 'bodies or facets'\nset ylabel 'ms'\nplot " +
           plots);
}

// --- Latency ---

void latency(const BenchOptions& options) {
  const Workload workload = options.quick ? pile(27, 4, kFrames) : pile(100, 8, 24);
  const int steps = options.quick ? 200 : 10000;
  constexpr int kPoints = 100;
  std::string data, plots;
  Table table({"latency", "threads", "steps", "median ms", "99 %", "99.9 %", "slowest", "99 % / median"});
  for (const int count : thread_counts(options)) {
    const std::vector<double> times = step_times(workload, count, steps);
    table.add({fmt::format("pile of {}", workload.bodies.size()), fmt::to_string(count), fmt::to_string(steps),
               three_digits(median(times)), three_digits(quantile(times, 0.99)), three_digits(quantile(times, 0.999)),
               three_digits(quantile(times, 1.0)), fmt::format("{:.2f}", quantile(times, 0.99) / median(times))});
    const std::string block = fmt::format("$t{}", count);
    data += block + " << EOD\n";
    for (int k = 0; k <= kPoints; ++k) {  // evenly on the axis
      const double slower = std::pow(10.0, -k * std::log10(steps) / kPoints);
      data += fmt::format("{:.6g} {:.6g}\n", slower, quantile(times, 1.0 - slower) / median(times));
    }
    data += "EOD\n";
    plots +=
        fmt::format("{}{} with lines lw 2 title '{}'", plots.empty() ? "" : ", ", block, thread_names({count}).front());
  }
  table.print();
  if (options.out.empty()) return;
  table.write_csv(options.out / "latency.csv");
  plot(options.out, "latency",
       data + fmt::format("set title 'the slowest of {0} steps of a pile'\nset logscale x\nset xrange [1:1.0/{0}]\n"
                          "set grid\nset key top left\nset yrange [0:*]\n"
                          "set xlabel 'part of the steps that took longer'\nset ylabel 'time over the median'\n"
                          "plot {1}, 1.5 dt 2 lc rgb 'black' title '1.5'",
                          steps, plots));
}

}  // namespace

int run_scaling(const BenchOptions& options) {
  fmt::print("{}\n\n", machine_line(thread_count(options.threads)));
  strong_scaling(options);
  weak_scaling(options);
  growth(options);
  latency(options);
  return 0;
}

}  // namespace tact::bench

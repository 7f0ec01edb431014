#include "bench/scaling/refresh.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/scaling/cutting.h"
#include "bench/table.h"
#include "bench/workloads/shapes.h"
#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

constexpr int kBytesAVertex = 24;

struct Subject {
  std::string name;
  std::string order;
  Shape shape;
  int bodies = 1;
  int frames = 2;  // each in memory of its own, so that large ones come from memory and not from a cache
};

// frames[frame][body]
using Frames = std::vector<std::vector<Eigen::Matrix3Xd>>;

Frames frames_of(const Subject& subject) {
  Frames frames(static_cast<std::size_t>(subject.frames));
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    for (int body = 0; body < subject.bodies; ++body) {
      Eigen::Matrix3Xd positions = subject.shape.positions;
      positions.row(0).array() += 4.0 * body;
      positions.row(2).array() += 0.01 * static_cast<double>(frame);
      frames[frame].push_back(std::move(positions));
    }
  }
  return frames;
}

constexpr std::size_t kRange = 1 << 15;  // doubles

// Of each body.
std::size_t ranges_of(const std::vector<Eigen::Matrix3Xd>& bodies) {
  return (static_cast<std::size_t>(bodies.front().size()) + kRange - 1) / kRange;
}

// The same memory, by bodies, large ones in ranges: work(body, first double, how many, number of the range). Returns
// how many ranges there are.
template <class Work>
std::size_t for_each_range(const std::vector<Eigen::Matrix3Xd>& bodies, int threads, const Work& work) {
  const std::size_t size = static_cast<std::size_t>(bodies.front().size());
  const std::size_t ranges = ranges_of(bodies), count = bodies.size() * ranges;
  base::parallel_for(count, 8, threads, [&](std::size_t k) {
    const std::size_t begin = k % ranges * kRange;
    work(k / ranges, begin, std::min(kRange, size - begin), k);
  });
  return count;
}

// Read and added up; `sums` has room for all ranges.
double sum_of_frame(const std::vector<Eigen::Matrix3Xd>& bodies, int threads, std::vector<double>& sums) {
  const auto add_up = [&](std::size_t body, std::size_t begin, std::size_t count, std::size_t range) {
    sums[range] = sum_of(bodies[body].data() + begin, count);
  };
  return sum_of(sums.data(), for_each_range(bodies, threads, add_up));
}

// Copied.
void copy_frame(const std::vector<Eigen::Matrix3Xd>& bodies, int threads, std::vector<Eigen::Matrix3Xd>& copies) {
  for_each_range(bodies, threads, [&](std::size_t body, std::size_t begin, std::size_t count, std::size_t) {
    std::copy_n(bodies[body].data() + begin, count, copies[body].data() + begin);
  });
}

struct Speed {
  double refresh_ms = 0.0;
  double sum_ms = 0.0;
  double copy_ms = 0.0;
};

Speed measure(const Subject& subject, const Frames& frames, int threads, double budget_ms) {
  World world({.threads = threads});
  std::vector<std::vector<PositionsUpdate>> updates(frames.size());
  for (const Eigen::Matrix3Xd& positions : frames.front()) {
    const BodyId id = world.add_body({.positions = positions, .facets = subject.shape.facets});
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      updates[frame].push_back({id, frames[frame][updates[frame].size()]});
    }
  }
  std::vector<double> refresh, sum, copy;
  std::vector<double> sums(frames.front().size() * ranges_of(frames.front()));
  // Two, in turn: like refresh, which keeps the last positions until the new ones are known to be good.
  std::vector<std::vector<Eigen::Matrix3Xd>> copies(2, frames.front());
  double total = 0.0;  // used, so that no sum is left out by the compiler
  const double start = wall_ms();
  world.set_positions(updates[0]);
  const double expected_ms = wall_ms() - start;
  world.detect();  // says which bodies have neighbours that make them look how far they reach: none
  for (std::size_t k = 1; k < 8 || wall_ms() - start < budget_ms; ++k) {
    const std::size_t frame = k % frames.size();
    refresh.push_back(time_ms(threads, expected_ms, [&] { world.set_positions(updates[frame]); }));
    const std::size_t other = (k + frames.size() / 2) % frames.size();  // not what set_positions has just read
    sum.push_back(time_ms(threads, expected_ms, [&] { total += sum_of_frame(frames[other], threads, sums); }));
  }
  // Apart from the others, whose caches it would fill.
  const double copy_start = wall_ms();
  for (std::size_t k = 0; k < 8 || wall_ms() - copy_start < 0.3 * budget_ms; ++k) {
    copy.push_back(time_ms(threads, expected_ms,
                           [&] { copy_frame(frames[k % frames.size()], threads, copies[k % copies.size()]); }));
  }
  if (!std::isfinite(total)) throw std::logic_error("a position is not finite");
  return {median(refresh), median(sum), median(copy)};
}

std::vector<Subject> subjects(bool quick) {
  const int large = quick ? 200 : 1000, many = quick ? 50 : 1000;
  std::vector<Subject> all;
  const Shape sheet = square_sheet(large, 10.0), blob = geodesic_sphere(8), small = geodesic_sphere(2);
  const std::string size = fmt::format("a sheet of {}² squares", large);
  all.push_back({size, "in order", sheet, 1, 8});
  all.push_back({size, "shuffled", shuffled(sheet, 21), 1, 8});
  all.push_back({"a blob of 1280 facets", "in order", blob, 1, 2});
  all.push_back({fmt::format("{} blobs of 1280", many), "in order", blob, many, 8});
  all.push_back({fmt::format("{} blobs of 1280", many), "shuffled", shuffled(blob, 22), many, 8});
  all.push_back({fmt::format("{} blobs of 80", 10 * many), "in order", small, 10 * many, 8});
  return all;
}

}  // namespace

int run_refresh(const BenchOptions& options) {
  std::vector<int> threads{1};
  if (thread_count(options.threads) > 1) threads.push_back(thread_count(options.threads));
  fmt::print("{}\n\n", machine_line(threads.back()));
  Table table({"mesh", "stored", "vertices", "threads", "ms", "million vertices/s", "GB/s read", "sum GB/s", "to sum",
               "copy GB/s", "to copy"});
  BarChart chart{.title = "refreshing a mesh against adding up its coordinates",
                 .unit = "part of the rate",
                 .bars = thread_names(threads)};
  for (const Subject& subject : subjects(options.quick)) {
    const Frames frames = frames_of(subject);
    chart.groups.push_back({subject.name + ", " + subject.order, {}});
    const double vertices = static_cast<double>(subject.shape.positions.cols()) * subject.bodies;
    for (const int count : threads) {
      const Speed speed = measure(subject, frames, count, options.quick ? 50.0 : 1500.0);
      const double gigabytes = 1e-6 * kBytesAVertex * vertices;  // a millisecond's worth: GB/s after division by ms
      table.add({subject.name, subject.order, fmt::format("{:.0f}", vertices), fmt::to_string(count),
                 three_digits(speed.refresh_ms), three_digits(1e-3 * vertices / speed.refresh_ms),
                 three_digits(gigabytes / speed.refresh_ms), three_digits(gigabytes / speed.sum_ms),
                 fmt::format("{:.2f}", speed.sum_ms / speed.refresh_ms), three_digits(gigabytes / speed.copy_ms),
                 fmt::format("{:.2f}", speed.copy_ms / speed.refresh_ms)});
      chart.groups.back().values.push_back(speed.sum_ms / speed.refresh_ms);
    }
  }
  table.print();
  fmt::print("\nmilliseconds on one thread:\n");
  const Table cutting = measure_cutting(options.quick);
  cutting.print();
  if (options.out.empty()) return 0;
  table.write_csv(options.out / "refresh.csv");
  cutting.write_csv(options.out / "cutting.csv");
  plot_bars(options.out, "refresh", chart);
  return 0;
}

}  // namespace tact::bench

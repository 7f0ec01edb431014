#include "bench/error/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/error/measure.h"
#include "bench/measure.h"
#include "bench/table.h"
#include "bench/tact_runner.h"
#include "bench/workloads/workloads.h"
#include "narrowphase/hull/support.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/mesh/refit.h"

namespace tact::bench {
namespace {

constexpr double kMostIterations = 1.2;  // promised of the mean on coherent motion
constexpr int kCoherentFrames = 96;      // of a period

// A median each, in microseconds, of the steps of one pair.
struct PairTimes {
  double hulls = 0.0;
  double direction = 0.0;
  double cull = 0.0;
  double stages() const { return hulls + direction + cull; }
};

PairTimes measure_pair(const Workload& workload, Accuracy accuracy, int steps) {
  TactRunner runner(workload, {.threads = 1, .accuracy = accuracy});
  std::array<std::vector<double>, 3> times;
  for (int step = 0; step < steps; ++step) {
    const StepStats& stats = runner.step(frame_of_step(step, workload.frames)).stats();
    if (step == 0) continue;  // without a last direction
    times[0].push_back(1e3 * stats.hulls_ms);
    times[1].push_back(1e3 * stats.direction_ms);
    times[2].push_back(1e3 * stats.cull_ms);
  }
  return {median(times[0]), median(times[1]), median(times[2])};
}

constexpr base::Vec3 kScanned{0.6, 0.0, 0.8};  // the direction of the scans, unit

// The farthest vertex, by one look at each: the support query of a library without a hierarchy.
Eigen::Index farthest_vertex(const Eigen::Matrix3Xd& positions) {
  const Eigen::Vector3d n(kScanned.x, kScanned.y, kScanned.z);
  Eigen::Index best = 0;
  double highest = -std::numeric_limits<double>::infinity();
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    const double height = n.dot(positions.col(v));
    if (height > highest) {
      // Stays a branch, which is seldom taken: with a maximum and a conditional move, which GCC 12 makes of an `if`
      // alone, each vertex may have to wait for the one before.
      asm volatile("");
      highest = height;
      best = v;
    }
  }
  return best;
}

// Of both bodies, over the caller's positions. `farthest` and `warmed` keep what was found, so that nothing is left out
// by the compiler.
double measure_plain_scan(const Workload& workload, int steps) {
  std::vector<double> times;
  Eigen::Index farthest = 0;
  double warmed = 0.0;
  for (int step = 0; step < steps; ++step) {
    const int frame = frame_of_step(step, workload.frames);
    for (const WorkloadBody& body : workload.bodies)
      warmed += body.positions(frame).sum();  // into the cache, as for the others
    const double start = wall_ms();
    for (const WorkloadBody& body : workload.bodies) farthest += farthest_vertex(body.positions(frame));
    times.push_back(1e3 * (wall_ms() - start));
  }
  if (farthest < 0 || !std::isfinite(warmed)) throw std::logic_error("a position is not finite");
  return median(times);
}

// The same with the engine's own loop, eight vertices at a time, where they lie cluster by cluster. What it finds is
// held against the plain scan before it is timed.
double measure_scan(const Workload& workload, int steps) {
  std::vector<narrowphase::ClusteredMesh> meshes;
  for (const WorkloadBody& body : workload.bodies) {
    const Eigen::Matrix3Xd& p = body.positions(0);
    meshes.emplace_back(std::span(p.data(), static_cast<std::size_t>(p.size())),
                        std::span(body.facets.data(), static_cast<std::size_t>(body.facets.size())));
    const int found = narrowphase::support_by_full_scan(meshes.back(), kScanned, {}).vertex;
    if (meshes.back().source_vertex(found) != farthest_vertex(p))
      throw std::logic_error("the scans find different vertices");
  }
  std::vector<double> times;
  for (int step = 0; step < steps; ++step) {
    const int frame = frame_of_step(step, workload.frames);
    for (std::size_t i = 0; i < meshes.size(); ++i) refit(meshes[i], workload.bodies[i].positions(frame).data());
    const double start = wall_ms();
    for (const narrowphase::ClusteredMesh& mesh : meshes) narrowphase::support_by_full_scan(mesh, kScanned, {});
    times.push_back(1e3 * (wall_ms() - start));
  }
  return median(times);
}

struct GrowthRow {
  double facets = 0.0;
  PairTimes exact;
  PairTimes paper;
  double plain_scan = 0.0;
  double scan = 0.0;
};

void write_growth(const std::vector<GrowthRow>& rows, const BenchOptions& options) {
  std::string data;
  for (const GrowthRow& row : rows) {
    data += fmt::format("{} {:.4g} {:.4g} {:.4g} {:.4g} {:.4g}\n", row.facets, row.exact.hulls + row.exact.direction,
                        row.exact.stages(), row.paper.stages(), row.scan, row.plain_scan);
  }
  plot(options.out, "growth",
       "$d << EOD\n" + data +
           "EOD\nset title 'narrow phase of one pair in coherent motion, one thread'\nset logscale xy\nset grid\n"
           "set key top left\nset xlabel 'facets of the pair'\nset ylabel 'µs'\n"
           "plot $d using 1:6 with lines dt 3 lc 0 title 'one plain scan of all vertices', "
           "$d using 1:5 with lines dt 2 lc 0 title 'one scan, eight at a time', "
           "$d using 1:4 with linespoints pt 7 title 'stages 3 to 5, paper', "
           "$d using 1:3 with linespoints pt 7 title 'stages 3 to 5, exact', "
           "$d using 1:2 with linespoints pt 7 title 'stages 3 and 4: hulls and direction'");
}

struct Coherent {
  std::string name;
  Workload workload;
};

std::vector<Coherent> coherent_workloads(bool quick) {
  if (quick)
    return {{"pile of 27 blobs", pile(27, 2, kCoherentFrames)}, {"organ and tool", organ_and_tool(kCoherentFrames)}};
  return {{"pile of 100 blobs of 320", pile(100, 4, kCoherentFrames)},
          {"organ and tool", organ_and_tool(kCoherentFrames)},
          {"cloth on sphere", cloth(40, kCoherentFrames)},
          {"two blobs of 20,480", large_pair(32, kCoherentFrames)}};
}

}  // namespace

void print_growth(const BenchOptions& options) {
  const std::vector<int> frequencies = options.quick ? std::vector{5, 9, 16} : std::vector{5, 9, 16, 28, 50, 89, 158};
  const int frames = options.quick ? 8 : kCoherentFrames;
  std::vector<GrowthRow> rows;
  for (const int frequency : frequencies) {
    const Workload workload = large_pair(frequency, frames);
    const int steps = options.quick ? 20 : frequency < 60 ? 2000 : 200;
    rows.push_back({static_cast<double>(workload.facet_count()), measure_pair(workload, Accuracy::exact, steps),
                    measure_pair(workload, Accuracy::paper, steps), measure_plain_scan(workload, steps),
                    measure_scan(workload, steps)});
  }
  fmt::print(
      "Stages 3 to 5 of a pair of blobs in coherent motion, µs, and one scan of all its vertices: plain, and eight at "
      "a time\n");
  Table table({"facets", "hulls", "direction", "exact: criteria", "exact: stages 3-5", "paper: zones, criteria",
               "paper: stages 3-5", "plain scan", "scan", "exact / plain", "exact / scan", "paper / scan"});
  for (const GrowthRow& row : rows) {
    table.add({fmt::format("{:.0f}", row.facets), three_digits(row.exact.hulls), three_digits(row.exact.direction),
               three_digits(row.exact.cull), three_digits(row.exact.stages()), three_digits(row.paper.cull),
               three_digits(row.paper.stages()), three_digits(row.plain_scan), three_digits(row.scan),
               three_digits(row.exact.stages() / row.plain_scan), three_digits(row.exact.stages() / row.scan),
               three_digits(row.paper.stages() / row.scan)});
  }
  // Over the whole range, which begins with the fixed cost of a pair, and over its last part, where bodies leave
  // caches.
  for (const std::size_t first : {std::size_t{0}, rows.size() - 2}) {
    const auto exponent = [&](const auto& time) {
      std::vector<double> facets, times;
      for (std::size_t i = first; i < rows.size(); ++i) {
        facets.push_back(rows[i].facets);
        times.push_back(time(rows[i]));
      }
      return fmt::format("{:.2f}", fitted_exponent(facets, times));
    };
    table.add({first == 0 ? "exponent" : "of the last two", exponent([](const auto& row) { return row.exact.hulls; }),
               exponent([](const auto& row) { return row.exact.direction; }),
               exponent([](const auto& row) { return row.exact.cull; }),
               exponent([](const auto& row) { return row.exact.stages(); }),
               exponent([](const auto& row) { return row.paper.cull; }),
               exponent([](const auto& row) { return row.paper.stages(); }),
               exponent([](const auto& row) { return row.plain_scan; }),
               exponent([](const auto& row) { return row.scan; }), "", "", ""});
  }
  table.print();
  if (options.out.empty()) return;
  table.write_csv(options.out / "growth.csv");
  write_growth(rows, options);
}

int print_iterations(const BenchOptions& options) {
  constexpr std::size_t kBins = 5;  // the last one holds the rest
  fmt::print("Iterations that carried directions took (shifted calls of GJK)\n");
  Table table({"workload", "directions", "none", "1", "2", "3", "4 or more", "mean"});
  int faults = 0;
  for (const Coherent& coherent : coherent_workloads(options.quick)) {
    TactRunner runner(coherent.workload, {.threads = 1, .accuracy = Accuracy::hulls});
    std::array<int, kBins> histogram{};
    int directions = 0, iterations = 0;
    for (int frame = 0; frame < coherent.workload.frames; ++frame) {
      for (const Contact& contact : runner.step(frame).contacts()) {
        if (contact.source != DirectionSource::carried) continue;
        ++directions;
        iterations += contact.iterations;
        ++histogram[std::min(static_cast<std::size_t>(contact.iterations), kBins - 1)];
      }
    }
    const double mean = static_cast<double>(iterations) / std::max(1, directions);
    std::vector<std::string> row{coherent.name, fmt::to_string(directions)};
    for (const int count : histogram) row.push_back(fmt::format("{:.1f} %", 100.0 * count / std::max(1, directions)));
    row.push_back(fmt::format("{:.3f}", mean));
    table.add(row);
    faults += mean > kMostIterations ? 1 : 0;
  }
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "iterations.csv");
  return faults;
}

}  // namespace tact::bench

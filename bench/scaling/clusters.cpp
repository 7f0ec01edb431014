#include "bench/scaling/clusters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "bench/measure.h"
#include "bench/table.h"
#include "bench/workloads/shapes.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/pairs/cluster_pairs.h"

namespace tact::bench {
namespace {

using narrowphase::BoxPairs;
using narrowphase::ClusteredMesh;
using narrowphase::ClusterJoin;
using narrowphase::ClusterPair;
using narrowphase::ClusterPairFinder;
using narrowphase::EmbreeDevice;
using narrowphase::KeptClusters;

constexpr base::Tuning kByLoop{.largest_loop = base::Tuning::kNever}, kByTrees{.largest_loop = 0};

ClusteredMesh clustered(const Shape& shape) {
  return {{shape.positions.data(), static_cast<std::size_t>(shape.positions.size())},
          {shape.facets.data(), static_cast<std::size_t>(shape.facets.size())}};
}

// A wavy sheet, 4 m wide; `delay` shifts its waves.
ClusteredMesh wavy_sheet(int cells, double delay) {
  Shape sheet = square_sheet(cells, 4.0);
  for (auto p : sheet.positions.colwise()) p.z() = 0.02 * (wave(0.8 * p.x() + delay) + wave(0.6 * p.y() - delay));
  return clustered(sheet);
}

KeptClusters all_clusters(const ClusteredMesh& mesh) {
  KeptClusters kept;
  keep_clusters({.mesh = &mesh}, 0.0, mesh.box(), kept);
  return kept;
}

template <class Run>
double median_us(double budget_ms, const Run& run) {
  std::vector<double> times;
  double expected_ms = 0.0;
  const double start = wall_ms();
  while (times.size() < 5 || wall_ms() - start < budget_ms) {
    times.push_back(time_ms(1, expected_ms, run));
    expected_ms = times.back();
  }
  return 1e3 * median(times);
}

void add_sheets(int cells, double budget_ms, EmbreeDevice& device, Table& table) {
  const ClusteredMesh mesh_a = wavy_sheet(cells, 0.0), mesh_b = wavy_sheet(cells, 0.3);
  const KeptClusters a = all_clusters(mesh_a), b = all_clusters(mesh_b);
  ClusterJoin join;
  std::vector<ClusterPair> by_loop, by_trees;
  const auto loop = [&] { join.run(a, b, BoxPairs::all, kByLoop, device, by_loop); };
  const auto trees = [&] { join.run(a, b, BoxPairs::all, kByTrees, device, by_trees); };
  const double loop_us = median_us(budget_ms, loop), trees_us = median_us(budget_ms, trees);
  if (by_loop != by_trees) throw std::runtime_error("the loop and the trees find different pairs");
  table.add({fmt::to_string(a.count()), fmt::to_string(static_cast<std::int64_t>(a.count()) * b.count()),
             fmt::to_string(by_loop.size()), three_digits(loop_us), three_digits(trees_us),
             three_digits(loop_us / trees_us)});
}

// A ball of 1,280 facets that comes within a millimetre of a sheet: each of its clusters, or the finder.
void add_ball(int cells, double budget_ms, EmbreeDevice& device, Table& table) {
  constexpr double kReach = 1e-3;
  Shape shape = geodesic_sphere(8);
  shape.positions *= 0.05;
  const ClusteredMesh ball = clustered(shape), sheet = wavy_sheet(cells, 0.0);
  ClusterPairFinder finder;
  std::vector<ClusterPair> by_loop;
  const auto loop = [&] {
    by_loop.clear();
    for (int i = 0; i < sheet.cluster_count(); ++i) {
      const base::Box box = base::grown(sheet.cluster_boxes()[i], kReach);
      if (!overlaps(box, ball.box())) continue;
      for (int k = 0; k < ball.cluster_count(); ++k) {
        if (overlaps(box, ball.cluster_boxes()[k])) by_loop.push_back({i, k});
      }
    }
  };
  std::span<const ClusterPair> found;
  const auto find = [&] { found = finder.find({.mesh = &sheet}, {.mesh = &ball}, kReach, base::kTuning, device); };
  const double loop_us = median_us(budget_ms, loop), find_us = median_us(budget_ms, find);
  if (!std::ranges::equal(found, by_loop)) throw std::runtime_error("the finder and a loop find different pairs");
  table.add({fmt::to_string(sheet.cluster_count()), fmt::to_string(found.size()), three_digits(loop_us),
             three_digits(find_us), three_digits(loop_us / find_us)});
}

}  // namespace

int run_clusters(const BenchOptions& options) {
  const double budget_ms = options.quick ? 2.0 : 300.0;
  const auto all_cells = options.quick ? std::vector<int>{32, 64} : std::vector<int>{64, 128, 181, 256, 362, 512, 724};
  fmt::print("{}\n\n", machine_line(1));
  EmbreeDevice device;
  Table sheets(
      {"clusters of each of two sheets", "pairs of boxes", "that overlap", "loop us", "trees us", "trees faster by"});
  Table balls({"clusters of a sheet", "pairs with a small ball", "each cluster us", "groups first us", "faster by"});
  for (const int cells : all_cells) {
    add_sheets(cells, budget_ms, device, sheets);
    add_ball(cells, budget_ms, device, balls);
  }
  sheets.print();
  fmt::print("\n");
  balls.print();
  if (!options.out.empty()) {
    sheets.write_csv(options.out / "clusters.csv");
    balls.write_csv(options.out / "ball_on_sheet.csv");
  }
  return 0;
}

}  // namespace tact::bench

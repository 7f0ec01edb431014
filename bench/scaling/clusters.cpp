#include "bench/scaling/clusters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "bench/measure.h"
#include "bench/table.h"
#include "bench/workloads/shapes.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/triangles/confirm.h"

namespace tact::bench {
namespace {

using narrowphase::ClusteredMesh;
using narrowphase::ClusterPair;
using narrowphase::ClusterPairWork;
using narrowphase::KeptClusters;

constexpr base::Tuning kByLoop{.largest_loop = base::Tuning::kNever}, kByTrees{.largest_loop = 0};

// A wavy sheet, 4 m wide; `delay` shifts its waves.
ClusteredMesh wavy_sheet(int cells, double delay) {
  Shape sheet = square_sheet(cells, 4.0);
  for (auto p : sheet.positions.colwise()) p.z() = 0.02 * (wave(0.8 * p.x() + delay) + wave(0.6 * p.y() - delay));
  return {{sheet.positions.data(), static_cast<std::size_t>(sheet.positions.size())},
          {sheet.facets.data(), static_cast<std::size_t>(sheet.facets.size())}};
}

KeptClusters all_clusters(const ClusteredMesh& mesh) {
  KeptClusters kept;
  kept.boxes.resize(mesh.cluster_count());
  for (int c = 0; c < mesh.cluster_count(); ++c) {
    kept.cluster.push_back(c);
    kept.boxes.set(static_cast<std::size_t>(c), mesh.cluster_boxes()[c]);
  }
  kept.bounds = mesh.box();
  return kept;
}

struct ClusterPairSearch {
  const KeptClusters& a;
  const KeptClusters& b;
  narrowphase::EmbreeDevice& device;
  std::vector<ClusterPair> pairs;
  ClusterPairWork scratch;

  void run(const base::Tuning& tuning) { find_cluster_pairs(a, b, tuning, device, pairs, scratch); }

  std::vector<std::int64_t> found() const {
    std::vector<std::int64_t> keys;
    for (const ClusterPair& pair : pairs) keys.push_back(static_cast<std::int64_t>(pair.a) * b.count() + pair.b);
    return keys;
  }
};

double median_us(ClusterPairSearch& search, const base::Tuning& tuning, double budget_ms) {
  std::vector<double> times;
  double expected_ms = 0.0;
  const double start = wall_ms();
  while (times.size() < 5 || wall_ms() - start < budget_ms) {
    times.push_back(time_ms(1, expected_ms, [&] { search.run(tuning); }));
    expected_ms = times.back();
  }
  return 1e3 * median(times);
}

}  // namespace

int run_clusters(const BenchOptions& options) {
  const double budget_ms = options.quick ? 2.0 : 300.0;
  fmt::print("{}\n\n", machine_line(1));
  narrowphase::EmbreeDevice device;
  Table table(
      {"clusters of each of two sheets", "pairs of boxes", "that overlap", "loop us", "trees us", "trees faster by"});
  for (const int cells :
       options.quick ? std::vector<int>{32, 64} : std::vector<int>{64, 128, 181, 256, 362, 512, 724}) {
    const ClusteredMesh mesh_a = wavy_sheet(cells, 0.0), mesh_b = wavy_sheet(cells, 0.3);
    const KeptClusters a = all_clusters(mesh_a), b = all_clusters(mesh_b);
    ClusterPairSearch search{a, b, device, {}, {}};
    search.run(kByLoop);
    const std::vector<std::int64_t> by_loop = search.found();
    search.run(kByTrees);
    if (search.found() != by_loop) throw std::runtime_error("the loop and the trees find different pairs");
    const double loop_us = median_us(search, kByLoop, budget_ms);
    const double trees_us = median_us(search, kByTrees, budget_ms);
    table.add({fmt::to_string(a.count()), fmt::to_string(static_cast<std::int64_t>(a.count()) * b.count()),
               fmt::to_string(by_loop.size()), three_digits(loop_us), three_digits(trees_us),
               three_digits(loop_us / trees_us)});
  }
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "clusters.csv");
  return 0;
}

}  // namespace tact::bench

#include "bench/scaling/grains.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "bench/measure.h"
#include "bench/random.h"
#include "bench/table.h"

namespace tact::bench {
namespace {

constexpr double kSpacing = 0.01;  // metres, of grains in a layer and of the vertices of a rope
constexpr double kMargin = 0.003;  // of every body
constexpr int kOfRope = 50;        // vertices
constexpr int kLayers = 10;        // of grains

// A heap that trembles: grains in one body, held against themselves, and ropes above them, a body each.
struct Heap {
  Eigen::Matrix3Xd grains;
  std::vector<Eigen::Matrix3Xd> ropes;

  Heap(int grain_count, int rope_count) : grains(3, grain_count), ropes(static_cast<std::size_t>(rope_count)) {
    const int side = std::max(1, static_cast<int>(std::sqrt(grain_count / kLayers)));
    for (int i = 0; i < grain_count; ++i)
      grains.col(i) << kSpacing * (i % side), kSpacing * (i / side % side), kSpacing * (0.2 + i / side / side);
    const double top = grains.row(2).maxCoeff() + 0.5 * kSpacing;
    for (int r = 0; r < rope_count; ++r) {
      Eigen::Matrix3Xd& rope = ropes[static_cast<std::size_t>(r)] = Eigen::Matrix3Xd(3, kOfRope);
      for (int k = 0; k < kOfRope; ++k)
        rope.col(k) << kSpacing * k, kSpacing * (0.5 + r % side), top + kSpacing * (r / side);
    }
  }

  void tremble(Random& random) {
    const auto by = [&] { return random.uniform(-0.05 * kSpacing, 0.05 * kSpacing); };
    for (double& x : grains.reshaped()) x += by();
    for (Eigen::Matrix3Xd& rope : ropes) {
      for (double& x : rope.reshaped()) x += by();
    }
  }
};

struct HeapWorld {
  World world;
  std::vector<BodyId> bodies;

  HeapWorld(const Heap& heap, int threads) : world({.threads = threads, .outputs = {.points = true}}) {
    world.add_plane({.margin = kMargin});
    std::vector<int> points(static_cast<std::size_t>(heap.grains.cols()));
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<int>(i);
    bodies.push_back(
        world.add_body({.positions = heap.grains, .points = points, .margin = kMargin, .self_contact = true}));
    Eigen::Matrix2Xi edges(2, kOfRope - 1);
    for (int k = 0; k + 1 < kOfRope; ++k) edges.col(k) << k, k + 1;
    for (const Eigen::Matrix3Xd& rope : heap.ropes)
      bodies.push_back(world.add_body({.positions = rope, .edges = edges, .margin = kMargin, .self_contact = true}));
  }
  void set(const Heap& heap) {
    std::vector<PositionsUpdate> updates{{bodies[0], heap.grains}};
    for (std::size_t r = 0; r < heap.ropes.size(); ++r) updates.push_back({bodies[r + 1], heap.ropes[r]});
    world.set_positions(updates);
  }
};

void add_row(int grains, int ropes, const BenchOptions& options, Table& table) {
  Random random(77);
  Heap heap(grains, ropes);
  HeapWorld scene(heap, 1);
  scene.world.detect();
  std::vector<double> set_ms, detect_ms, patches_ms;
  std::int64_t points = 0;
  const auto measure = [&](std::vector<double>& steps_ms) {
    for (int step = 0; step < (options.quick ? 2 : 7); ++step) {
      heap.tremble(random);
      set_ms.push_back(time_ms(1, 1.0, [&] { scene.set(heap); }));
      steps_ms.push_back(time_ms(1, 1.0, [&] { points = scene.world.detect().stats().points; }));
    }
  };
  measure(detect_ms);
  Settings settings = scene.world.settings();
  settings.outputs.patches = true;
  scene.world.set_settings(settings);
  scene.world.detect();
  measure(patches_ms);
  if (points < grains / kLayers / 2) throw std::runtime_error(fmt::format("{} points of {} grains", points, grains));
  const double vertices = grains + static_cast<double>(ropes) * kOfRope;
  const double set = median(set_ms), detect = median(detect_ms), patches = median(patches_ms);
  table.add({fmt::to_string(grains), fmt::to_string(ropes), fmt::to_string(points), three_digits(set),
             three_digits(detect), three_digits(1e6 * (set + detect) / vertices),
             three_digits(1e6 * (set + patches) / vertices)});
}

}  // namespace

int run_grains(const BenchOptions& options) {
  Table table({"grains", "ropes", "points", "set ms", "detect ms", "ns a vertex", "with patches"});
  add_row(1000, 10, options, table);
  add_row(10000, 100, options, table);
  if (!options.quick) add_row(100000, 1000, options, table);
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "grains.csv");
  return 0;
}

}  // namespace tact::bench

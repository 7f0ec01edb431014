// The same steps on OpenMP's threads, on a pool of std::thread and in an arena of TBB: prints the hash of each, and
// fails if they differ.
#include <tact/tact.h>

#include <cinttypes>
#include <cstdio>
#include <memory>
#include <vector>

#include "tbb_arena.h"
#include "thread_pool.h"

namespace {

constexpr int kThreads = 4, kBodies = 60, kSteps = 5;

// The corners of a box with sides of about 1, from a formula that gives each body another place.
std::vector<double> box(int body, int step) {
  std::vector<double> positions;
  for (int vertex = 0; vertex < 8; ++vertex) {
    for (int axis = 0; axis < 3; ++axis) {
      const int scrambled = (body * (axis + 3) * 37 + vertex * 11) % 64;
      positions.push_back((vertex >> axis & 1) + (body >> axis) % 4 * 0.75 + (scrambled + step * (body % 3)) / 256.0);
    }
  }
  return positions;
}

std::uint64_t last_hash(std::shared_ptr<tact::Executor> executor) {
  const std::vector<int> facets = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  const Eigen::Map<const Eigen::Matrix3Xi> facet_columns(facets.data(), 3, 12);
  const auto columns = [](const std::vector<double>& positions) {
    return Eigen::Map<const Eigen::Matrix3Xd>(positions.data(), 3, 8);
  };
  tact::World world({.threads = kThreads, .executor = std::move(executor)});
  std::vector<tact::BodyId> bodies;
  for (int body = 0; body < kBodies; ++body) {
    const std::vector<double> positions = box(body, 0);
    bodies.push_back(world.add_body({.positions = columns(positions), .facets = facet_columns}));
  }
  std::uint64_t hash = 0;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<std::vector<double>> positions;
    std::vector<tact::PositionsUpdate> updates;
    for (int body = 0; body < kBodies; ++body) positions.push_back(box(body, step));
    for (int body = 0; body < kBodies; ++body) updates.push_back({bodies[body], columns(positions[body])});
    world.set_positions(updates);
    hash = hash * 31 + world.detect().hash();
  }
  return hash;
}

}  // namespace

int main() {
  const std::uint64_t openmp = last_hash(nullptr);
  const std::uint64_t pool = last_hash(std::make_shared<ThreadPool>(kThreads - 1));
  const std::uint64_t arena = last_hash(std::make_shared<TbbArena>(kThreads));
  std::printf("OpenMP %016" PRIx64 "\nstd::thread %016" PRIx64 "\nTBB %016" PRIx64 "\n", openmp, pool, arena);
  return openmp == pool && openmp == arena ? 0 : 1;
}

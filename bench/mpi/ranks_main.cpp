// What `tact-bench mpi` starts with mpirun: a block of balls over the ranks, a JSON object on standard output.
#include <mpi.h>
#include <sys/resource.h>
#include <tact/mpi/world.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "scenes/library/random.h"
#include "scenes/library/shapes.h"

namespace tact::bench {
namespace {

using scenes::Vec3;

struct Case {
  int bodies = 216;            // a rank, about
  int levels = 1;              // of scenes::sphere(): 80 facets
  int moving = 10, still = 5;  // steps
  int threads = 1;
  bool points = true;
  std::string partitioner = "rcb";
};

constexpr double kRadius = 0.5;    // metres
constexpr double kSpacing = 0.98;  // of the balls' centres, metres: each meets its six neighbours
constexpr double kMargin = 0.005;  // metres

// As high as it is wide: ball i of side³.
class Block {
 public:
  Block(std::int64_t count, int levels)
      : side_(std::max<std::int64_t>(1, std::llround(std::cbrt(static_cast<double>(count))))),
        mesh_(scenes::sphere(levels, kRadius)) {}

  std::int64_t count() const { return side_ * side_ * side_; }
  const Eigen::Matrix3Xi& facets() const { return mesh_.facets; }
  // Each ball swings about its place, with a phase and a direction of its own.
  void place(std::uint64_t ball, int step, std::vector<Vec3>& positions) const {
    constexpr double kAmplitude = 0.01;  // metres: neighbours meet, and part
    scenes::Random random(ball);
    const Vec3 way{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    const double phase = random.between(0.0, 6.0);
    const auto i = static_cast<std::int64_t>(ball);
    const Vec3 cell{static_cast<double>(i % side_), static_cast<double>(i / side_ % side_),
                    static_cast<double>(i / (side_ * side_))};
    const Vec3 center = kSpacing * cell + (kAmplitude * std::sin(0.5 * step + phase)) * way;
    positions.resize(mesh_.positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = mesh_.positions[v] + center;
  }

 private:
  std::int64_t side_;
  scenes::Mesh mesh_;
};

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Of a rank's value: the mean over the ranks and the largest.
nlohmann::json over_ranks(double value) {
  double sum = 0.0, most = 0.0;
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Allreduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(&value, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return {{"mean", sum / ranks}, {"max", most}};
}

void move_all(mpi::World& world, const Block& block, int step) {
  const std::vector<std::uint64_t> keys = world.bodies();
  std::vector<std::vector<Vec3>> positions(keys.size());
  std::vector<mpi::PositionsUpdate> updates;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    block.place(keys[i], step, positions[i]);
    updates.push_back({keys[i], scenes::as_matrix(positions[i])});
  }
  world.set_positions(updates);
}

void add_share(mpi::World& world, const Block& block) {
  const std::int64_t begin = block.count() * world.rank() / world.rank_count(),
                     end = block.count() * (world.rank() + 1) / world.rank_count();
  std::vector<Vec3> positions;
  for (std::int64_t i = begin; i < end; ++i) {
    const auto key = static_cast<std::uint64_t>(i);
    block.place(key, 0, positions);
    world.add_body(
        {.positions = scenes::as_matrix(positions), .facets = block.facets(), .key = key, .margin = kMargin});
  }
}

// Steps in which all moves, or nothing; the counts of a step, and the middle of the times.
nlohmann::json run_steps(mpi::World& world, const Block& block, int first, int count, bool moves) {
  mpi::Statistics sums;
  std::vector<double> times;
  for (int step = first; step < first + count; ++step) {
    MPI_Barrier(MPI_COMM_WORLD);
    if (moves) move_all(world, block, step);
    MPI_Barrier(MPI_COMM_WORLD);
    const double start = wall_ms();
    const mpi::Statistics& stats = world.detect().stats();
    MPI_Barrier(MPI_COMM_WORLD);
    times.push_back(wall_ms() - start);
    for (const auto& field : mpi::kStatisticsCounts) sums.*field.value += stats.*field.value;
  }
  nlohmann::json json;
  for (const auto& field : mpi::kStatisticsCounts)
    json[field.name] = over_ranks(static_cast<double>(sums.*field.value) / count);
  json["ms"] = median(times);
  return json;
}

nlohmann::json run(const Case& played) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const double before = peak_mb();
  const Block block(std::int64_t{played.bodies} * ranks, played.levels);
  mpi::Settings settings{.world = {.threads = played.threads, .outputs = {.points = played.points}}};
  if (played.partitioner == "hsfc") settings.partitioner = mpi::Partitioner::hsfc;
  mpi::World world(MPI_COMM_WORLD, settings);
  add_share(world, block);
  const double added = peak_mb();
  world.rebalance();
  for (int warm = 1; warm <= 2; ++warm) {  // by the work of a step; the second time by that of the shares of the first
    move_all(world, block, warm);
    world.detect();
    world.rebalance();
  }
  move_all(world, block, 3);
  world.detect();
  nlohmann::json moving = run_steps(world, block, 4, played.moving, true);
  world.detect();
  nlohmann::json still = run_steps(world, block, 0, played.still, false);
  const std::uint64_t own = world.detect().hash_sum();
  std::uint64_t all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return {{"ranks", ranks},
          {"bodies", block.count()},
          {"facets", block.facets().cols()},
          {"moving", moving},
          {"still", still},
          {"start_mb", over_ranks(before)},
          {"added_mb", over_ranks(added)},
          {"peak_mb", over_ranks(peak_mb())},
          {"hash", all}};
}

}  // namespace
}  // namespace tact::bench

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  tact::bench::Case played;
  CLI::App program("A block of balls over the ranks of mpirun; `tact-bench mpi` starts it.", "tact-bench-ranks");
  program.add_option("--bodies", played.bodies, "A rank, about")->check(CLI::Range(1, 100000000));
  program.add_option("--levels", played.levels, "20 * 4^levels facets a ball")->check(CLI::Range(0, 6));
  program.add_option("--moving", played.moving, "Steps in which all balls move")->check(CLI::Range(1, 1000000));
  program.add_option("--still", played.still, "Steps in which none does")->check(CLI::Range(1, 1000000));
  program.add_option("--threads", played.threads, "Of each rank")->check(CLI::Range(1, 1024));
  program.add_flag("!--no-points", played.points, "Without contact points");
  program.add_option("--partitioner", played.partitioner)->check(CLI::IsMember({"rcb", "hsfc"}));
  CLI11_PARSE(program, argc, argv);
  try {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const nlohmann::json result = tact::bench::run(played);
    if (rank == 0) std::cout << result.dump() << std::endl;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tact-bench-ranks: %s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}

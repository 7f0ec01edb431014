#include "bench/mpi/mpi.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/table.h"

namespace tact::bench {
namespace {

using Json = nlohmann::json;

// Runs tact-bench-ranks, which lies beside this program, on so many ranks. They share the cores: mpirun would keep all
// threads of a rank on one.
Json run_ranks(int ranks, const std::string& arguments) {
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "tact-bench-ranks";
  const std::string command = fmt::format(
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe --bind-to none -n {} '{}' {}",
      ranks, program.string(), arguments);
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("mpirun cannot be started");
  std::string text;
  std::array<char, 4096> part;
  for (std::size_t count; (count = std::fread(part.data(), 1, part.size(), pipe.get())) > 0;)
    text.append(part.data(), count);
  if (const int status = pclose(pipe.release()); status != 0)
    throw std::runtime_error(
        fmt::format("status {} of: {}", WIFEXITED(status) ? WEXITSTATUS(status) : status, command));
  return Json::parse(text);
}

double mean(const Json& of_steps, const char* count) { return of_steps.at(count).at("mean"); }
double most(const Json& of_steps, const char* count) { return of_steps.at(count).at("max"); }

std::string count_text(double value) { return fmt::format("{:.0f}", value); }

Table counts_table() {
  return Table({"partitioner", "ranks", "bodies a rank", "ghosts", "most ghosts", "ghosts a body", "kB", "most kB",
                "positions kB", "boxes kB", "results kB", "messages", "most messages", "pairs, max over mean",
                "at rest kB", "at rest positions kB", "peak MB"});
}

void add_row(const std::string& partitioner, const Json& run, Table& table) {
  const Json &moving = run.at("moving"), &still = run.at("still");
  const auto kb = [](double bytes) { return three_digits(bytes / 1e3); };
  table.add({partitioner, count_text(run.at("ranks")), three_digits(mean(moving, "own_bodies")),
             three_digits(mean(moving, "ghosts")), count_text(most(moving, "ghosts")),
             three_digits(mean(moving, "ghosts") / mean(moving, "own_bodies")), kb(mean(moving, "bytes")),
             kb(most(moving, "bytes")), kb(mean(moving, "positions_bytes")), kb(mean(moving, "box_bytes")),
             kb(mean(moving, "result_bytes")), three_digits(mean(moving, "messages")),
             count_text(most(moving, "messages")),
             three_digits(most(moving, "pairs") / std::max(mean(moving, "pairs"), 1.0)), kb(mean(still, "bytes")),
             kb(most(still, "positions_bytes")), three_digits(run.at("peak_mb").at("max"))});
}

// What is asked for beside what was seen.
class Bounds {
 public:
  void add(const std::string& what, double seen, double bound) {
    table_.add({what, three_digits(seen), three_digits(bound), seen <= bound ? "yes" : "no"});
  }
  void finish(const BenchOptions& options) const {
    table_.print();
    if (!options.out.empty()) table_.write_csv(options.out / "bounds.csv");
  }

 private:
  Table table_{{"bound", "seen", "at most", "kept"}};
};

// Blocks of a cube have 3 neighbouring faces at 8 ranks, 4 at 27 and 4.5 at 64.
void add_growth(const std::map<int, Json>& runs, Bounds& bounds) {
  const auto moving = [&](int ranks) { return runs.at(ranks).at("moving"); };
  for (const char* const count : {"ghosts", "bytes"}) {
    if (!runs.contains(64)) break;  // a quick run
    const auto name = [&](const char* kind, int fewer) {
      return fmt::format("{} {} at 64 ranks over {}", kind, count, fewer);
    };
    bounds.add(name("mean", 27), mean(moving(64), count) / mean(moving(27), count), 1.25);
    bounds.add(name("mean", 8), mean(moving(64), count) / mean(moving(8), count), 1.7);
    bounds.add(name("largest", 27), most(moving(64), count) / most(moving(27), count), 1.3);
  }
  double positions = 0.0;
  for (const auto& [ranks, run] : runs) positions = std::max(positions, most(run.at("still"), "positions_bytes"));
  bounds.add("bytes of positions at rest", positions, 0.0);
}

// Two ranks of a thread against one rank of two, in turns; the better of the rounds. The answers are compared.
void add_two_ranks(const BenchOptions& options, Bounds& bounds) {
  const int bodies = options.quick ? 216 : 2197, steps = options.quick ? 3 : 15, rounds = options.quick ? 1 : 3;
  double two_ranks = 1e300, two_threads = 1e300;
  for (int round = 0; round < rounds; ++round) {
    const std::string shared = fmt::format("--levels 2 --moving {} --still 1", steps);
    const Json ranks = run_ranks(2, fmt::format("--bodies {} --threads 1 {}", bodies / 2, shared));
    const Json threads = run_ranks(1, fmt::format("--bodies {} --threads 2 {}", bodies, shared));
    if (ranks.at("hash") != threads.at("hash") || ranks.at("bodies") != threads.at("bodies"))
      throw std::runtime_error("2 ranks and 1 rank have other answers");
    two_ranks = std::min<double>(two_ranks, ranks.at("moving").at("ms"));
    two_threads = std::min<double>(two_threads, threads.at("moving").at("ms"));
  }
  fmt::print("a step of {} balls of 320 facets: 2 ranks {} ms, 1 rank with 2 threads {} ms\n\n", bodies,
             three_digits(two_ranks), three_digits(two_threads));
  bounds.add("time of 2 ranks over 1 rank with 2 threads", two_ranks / two_threads, 1.15);
}

// Does a rank hold what it owns and what is near, whatever there is besides?
void print_memory(const BenchOptions& options) {
  Table table({"ranks", "bodies", "facets a body", "bodies a rank", "ghosts", "peak MB, mean", "peak MB, most",
               "kB a body and ghost", "kB sent a step"});
  const std::vector<std::pair<int, int>> cases =
      options.quick ? std::vector<std::pair<int, int>>{{4, 500}}
                    : std::vector<std::pair<int, int>>{{1, 15625}, {2, 15625}, {4, 15625}, {8, 15625}, {16, 15625}};
  for (const auto& [ranks, bodies] : cases) {
    const Json run = run_ranks(ranks, fmt::format("--bodies {} --moving 1 --still 1 --no-points", bodies));
    const Json& moving = run.at("moving");
    const double held = mean(moving, "own_bodies") + mean(moving, "ghosts"),
                 grown = run.at("peak_mb").at("mean").get<double>() - run.at("start_mb").at("mean").get<double>();
    table.add({count_text(ranks), count_text(run.at("bodies")), count_text(run.at("facets")),
               count_text(mean(moving, "own_bodies")), count_text(mean(moving, "ghosts")),
               three_digits(run.at("peak_mb").at("mean")), three_digits(run.at("peak_mb").at("max")),
               three_digits(1e3 * grown / held), three_digits(mean(moving, "bytes") / 1e3)});
  }
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "memory.csv");
}

}  // namespace

int run_mpi(const BenchOptions& options) {
  fmt::print("{}\n\n", machine_line(2));
  const int bodies = options.quick ? 64 : 216;
  Table table = counts_table();
  const auto play = [&](const std::string& partitioner, const std::vector<int>& ranks) {
    std::map<int, Json> runs;
    for (const int count : ranks) {
      const std::string arguments =
          fmt::format("--bodies {} --partitioner {} --moving 5 --still 2", bodies, partitioner);
      runs[count] = run_ranks(count, arguments);
      add_row(partitioner, runs[count], table);
      if (!options.out.empty()) table.write_csv(options.out / "ranks.csv");
    }
    return runs;
  };
  Bounds bounds;
  const std::vector<int> few{1, 2, 4}, many{1, 2, 4, 8, 16, 27, 32, 64};
  add_growth(play("rcb", options.quick ? few : many), bounds);
  add_two_ranks(options, bounds);
  play("hsfc", options.quick ? std::vector<int>{2} : std::vector<int>{8, 27, 64});
  table.print();
  bounds.finish(options);
  print_memory(options);
  return 0;
}

}  // namespace tact::bench

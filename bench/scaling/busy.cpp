#include "bench/scaling/busy.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bench/measure.h"
#include "bench/table.h"
#include "bench/tact_runner.h"
#include "bench/workloads/workloads.h"
#include "examples/executors/thread_pool.h"

namespace tact::bench {
namespace {

// Processes that do nothing but keep a core busy, as long as this lives.
class BusyProcesses {
 public:
  explicit BusyProcesses(int count) {
    for (int k = 0; k < count; ++k) {
      const pid_t process = fork();
      if (process == 0) spin();
      if (process > 0) processes_.push_back(process);
    }
  }
  ~BusyProcesses() {
    for (const pid_t process : processes_) {
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
    }
  }
  BusyProcesses(const BusyProcesses&) = delete;
  BusyProcesses& operator=(const BusyProcesses&) = delete;

 private:
  // Until it is killed, or its parent is gone.
  [[noreturn]] static void spin() {
    for (const pid_t parent = getppid();;) {
      for (std::atomic<int> k = 0; k < 1'000'000; ++k) {
      }
      if (getppid() != parent) _exit(0);
    }
  }
  std::vector<pid_t> processes_;
};

struct Scene {
  std::string name;
  std::function<Workload()> make;
};

struct Way {
  std::string name;
  int threads;
  std::shared_ptr<Executor> executor;
};

// Wall times of steps in milliseconds, a list for each way. The ways take turns, many steps at a time.
std::vector<std::vector<double>> measure(const Workload& workload, const std::vector<Way>& ways, double budget_ms) {
  constexpr double kTurn_ms = 100.0;
  std::vector<std::unique_ptr<TactRunner>> runners;
  for (const Way& way : ways) {
    runners.push_back(
        std::make_unique<TactRunner>(workload, Settings{.threads = way.threads, .executor = way.executor}));
    runners.back()->step(0);
  }
  std::vector<std::vector<double>> times(ways.size());
  std::vector<int> steps(ways.size());
  for (const double start = wall_ms(); wall_ms() - start < budget_ms * static_cast<double>(ways.size());) {
    for (std::size_t k = 0; k < ways.size(); ++k) {
      for (const double turn = wall_ms(); wall_ms() - turn < kTurn_ms;) {
        const double begin = wall_ms();
        runners[k]->step(++steps[k] % workload.frames);
        times[k].push_back(wall_ms() - begin);
      }
    }
  }
  return times;
}

}  // namespace

int run_busy(const BenchOptions& options) {
  const int threads = thread_count(options.threads);
  const double budget_ms = options.quick ? 100.0 : 4000.0;
  fmt::print("{}\n\n", machine_line(threads));
  std::vector<Scene> scenes{
      {"8 blobs of 320", [] { return pile(8, 4, 6); }},
      {"2 blobs of 13,520", [] { return large_pair(26, 6); }},
      {"8 blobs of 1,280", [] { return pile(8, 8, 6); }},
      {"a pile of 30 blobs of 1,280", [] { return pile(30, 8, 6); }},
      {"a pile of 100 blobs of 1,280", [] { return pile(100, 8, 6); }},
      {"a pile of 400 blobs of 1,280", [] { return pile(400, 8, 6); }},
  };
  if (options.quick) scenes.resize(2);
  const std::vector<Way> ways{
      {"1 thread", 1, nullptr},
      {"OpenMP", threads, nullptr},
      {"std::thread pool", threads, std::make_shared<ThreadPool>(threads - 1)},
  };
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  Table table(
      {"scene", "busy processes", "threads", "median ms", "of 1 thread", "slowest hundredth ms", "of 1 thread"});
  for (const Scene& scene : scenes) {
    if (!options.plays(scene.name)) continue;
    const Workload workload = scene.make();
    for (const int busy : {0, 1, cores, 2 * cores}) {
      const BusyProcesses processes(busy);
      const auto times = measure(workload, ways, budget_ms);
      for (std::size_t k = 0; k < ways.size(); ++k) {
        const auto figure = [&](double part) {
          return std::array{three_digits(quantile(times[k], part)),
                            three_digits(quantile(times[k], part) / quantile(times[0], part))};
        };
        const auto [middle, middle_part] = figure(0.5);
        const auto [slow, slow_part] = figure(0.99);
        table.add({scene.name, fmt::to_string(busy), fmt::format("{} {}", ways[k].threads, ways[k].name), middle,
                   middle_part, slow, slow_part});
      }
    }
  }
  if (table.empty()) options.reject_only();
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "busy.csv");
  return 0;
}

}  // namespace tact::bench

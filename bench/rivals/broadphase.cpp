#include "bench/rivals/broadphase.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/rivals/box_rival.h"
#include "bench/table.h"
#include "tests/support/generators/box_workloads.h"
#include "tests/support/oracles/box_pairs.h"

namespace tact::bench {
namespace {

using broadphase::IndexPair;
using tests::BoxWorkload;
using tests::BoxWorkloadKind;

constexpr std::uint64_t kSeed = 2024;
constexpr std::size_t kBruteForce = 10000;  // up to this many boxes the truth is every pair compared, above it CGAL's
constexpr double kPatience = 500.0;         // ms: a rival that took longer for fewer boxes is not asked about more

struct Effort {
  std::vector<std::size_t> counts;
  int checked_steps;
  int most_steps;
  double budget_ms;  // for a rival, a workload, a number of boxes and of threads; two steps are always timed
};

Effort effort_for(bool quick) {
  if (quick) return {{1000, 4000}, 2, 5, 20.0};
  return {{10000, 100000, 1000000}, 2, 60, 3000.0};
}

struct Times {
  double least = 0.0;
  double median = 0.0;
  bool correct = true;
};

std::vector<IndexPair> truth(const BoxWorkload& workload) {
  if (workload.boxes().size() <= kBruteForce) {
    return tests::all_overlapping_pairs(workload.boxes(), workload.filters());
  }
  const auto cgal = make_box_cgal(workload.boxes().size(), 1);
  cgal->step({workload.boxes(), workload.changed()});
  return cgal->pairs();
}

bool suits(const BoxRivalKind& rival, BoxWorkloadKind kind) {
  return rival.takes_empty_boxes || kind != BoxWorkloadKind::churn;
}

// The first step is not timed: it is the only one of its kind in a scene.
Times measure(const BoxRivalKind& kind, BoxWorkload workload, int threads, const Effort& effort,
              const std::vector<std::vector<IndexPair>>& truths) {
  const auto rival = kind.make(workload.boxes().size(), threads);
  Times times;
  std::vector<double> all_ms;
  double spent_ms = 0.0;
  for (int step = 0; step <= effort.most_steps; ++step) {
    if (step > 0) workload.step();
    const double expected_ms = all_ms.empty() ? 1.0 : all_ms.back();
    const double ms = time_ms(threads, expected_ms, [&] { rival->step({workload.boxes(), workload.changed()}); });
    if (step < effort.checked_steps && rival->pairs() != truths[step]) times.correct = false;
    if (step == 0) continue;
    all_ms.push_back(ms);
    spent_ms += ms;
    if (step >= 2 && spent_ms > effort.budget_ms) break;
  }
  times.least = *std::ranges::min_element(all_ms);
  times.median = median(all_ms);
  return times;
}

// Median times of tact by workload, then by number of boxes: what the growth is fitted to.
using Medians = std::map<std::string, std::vector<double>>;

class Run {
 public:
  Run(const Effort& effort, std::vector<int> threads)
      : effort_(effort), threads_(std::move(threads)), table_(header()) {}

  void measure_workload(BoxWorkloadKind kind) {
    for (const std::size_t count : effort_.counts) {
      BoxWorkload workload(kind, count, kSeed);
      std::vector<std::vector<IndexPair>> truths;
      for (BoxWorkload steps = workload; static_cast<int>(truths.size()) < effort_.checked_steps; steps.step()) {
        truths.push_back(truth(steps));
      }
      for (const int threads : threads_) add_row(kind, workload, threads, truths);
    }
  }

  bool correct() const { return correct_; }
  const Table& table() const { return table_; }
  const Medians& medians() const { return medians_; }

 private:
  static std::vector<std::string> header() {
    std::vector<std::string> cells{"workload", "boxes", "pairs", "threads"};
    for (const BoxRivalKind& rival : box_rivals()) {
      cells.push_back(fmt::format("{} ms", rival.name));
      if (&rival == &box_rivals().front()) cells.push_back("least ms");
    }
    cells.push_back("tact faster by");
    return cells;
  }

  void add_row(BoxWorkloadKind kind, const BoxWorkload& workload, int threads,
               const std::vector<std::vector<IndexPair>>& truths) {
    std::vector<std::string> cells{name_of(kind), std::to_string(workload.boxes().size()),
                                   std::to_string(truths.back().size()), std::to_string(threads)};
    double own = 0.0;
    double fastest = 0.0;
    for (const BoxRivalKind& rival : box_rivals()) {
      const bool is_tact = &rival == &box_rivals().front();
      double& last_ms = last_ms_[fmt::format("{},{},{}", rival.name, name_of(kind), threads)];
      if (!suits(rival, kind) || (!is_tact && last_ms > kPatience)) {
        cells.push_back("-");
        continue;
      }
      const Times times = measure(rival, workload, threads, effort_, truths);
      last_ms = times.median;
      cells.push_back(times.correct ? three_digits(times.median) : "wrong");
      correct_ = correct_ && times.correct;
      if (is_tact) {
        own = times.median;
        cells.push_back(three_digits(times.least));
        medians_[fmt::format("{},{}", name_of(kind), threads)].push_back(own);
      } else if (rival.make != make_box_tact_from_scratch && (fastest == 0.0 || times.median < fastest)) {
        fastest = times.median;
      }
    }
    cells.push_back(fastest > 0.0 ? three_digits(fastest / own) : "-");
    table_.add(cells);
    fmt::print("{} {} boxes, {} threads: {} ms\n", cells[0], cells[1], cells[3], cells[4]);
    std::fflush(stdout);
  }

  Effort effort_;
  std::vector<int> threads_;
  Table table_;
  Medians medians_;
  std::map<std::string, double> last_ms_;  // of a rival, a workload and a number of threads
  bool correct_ = true;
};

Table growth_table(const Medians& medians, const std::vector<std::size_t>& counts) {
  std::vector<std::string> header{"workload", "threads"};
  for (std::size_t k = 1; k < counts.size(); ++k) header.push_back(fmt::format("{} to {}", counts[k - 1], counts[k]));
  header.push_back("all");
  Table table(header);
  const std::vector<double> sizes(counts.begin(), counts.end());
  for (const auto& [name, ms] : medians) {
    const std::size_t comma = name.find(',');
    std::vector<std::string> row{name.substr(0, comma), name.substr(comma + 1)};
    for (std::size_t k = 1; k < sizes.size(); ++k) {
      row.push_back(fmt::format("{:.2f}", fitted_exponent({sizes[k - 1], sizes[k]}, {ms[k - 1], ms[k]})));
    }
    row.push_back(fmt::format("{:.2f}", fitted_exponent(sizes, ms)));
    table.add(row);
  }
  return table;
}

// Time a box over the number of boxes, one thread: flat lines are growth in proportion.
std::string plot_script(const Medians& medians, const std::vector<std::size_t>& counts) {
  std::string data;
  std::string curves;
  for (const auto& [name, ms] : medians) {
    if (!name.ends_with(",1")) continue;
    const std::string title = name.substr(0, name.find(','));
    data += fmt::format("${} << end\n", title);
    for (std::size_t k = 0; k < counts.size(); ++k) {
      data += fmt::format("{} {}\n", counts[k], 1e6 * ms[k] / static_cast<double>(counts[k]));
    }
    data += "end\n";
    curves += fmt::format("{}${} with linespoints title '{}' noenhanced", curves.empty() ? "" : ", ", title, title);
  }
  return data + "set logscale xy\nset grid\nset key outside right\nset xlabel 'boxes'\n" +
         "set ylabel 'nanoseconds a box and step, one thread'\nplot " + curves;
}

}  // namespace

int run_broadphase(const BenchOptions& options) {
  // Embree allocates in every call, and the C library would give the memory back each time.
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  const int most_threads = thread_count(options.threads);
  std::vector<int> threads{1};
  if (most_threads >= 2) threads.push_back(2);
  if (most_threads > 2) threads.push_back(most_threads);
  const Effort effort = effort_for(options.quick);
  fmt::print("{}\nMedian milliseconds a step, from the boxes to the complete list of pairs; tact's list is sorted.\n\n",
             machine_line(most_threads));
  Run run(effort, threads);
  for (const BoxWorkloadKind kind : tests::all_box_workloads()) run.measure_workload(kind);
  fmt::print("\n");
  run.table().print();
  const Table growth = growth_table(run.medians(), effort.counts);
  fmt::print("Exponent of tact's time over the number of boxes\n");
  growth.print();
  if (!options.out.empty()) {
    run.table().write_csv(options.out / "broadphase.csv");
    growth.write_csv(options.out / "broadphase_growth.csv");
    plot(options.out, "broadphase", plot_script(run.medians(), effort.counts));
  }
  if (!run.correct()) fmt::print("An answer was WRONG.\n");
  return run.correct() ? 0 : 1;
}

}  // namespace tact::bench

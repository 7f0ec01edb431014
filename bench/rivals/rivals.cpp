#include "bench/rivals/rivals.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "bench/answer_line.h"
#include "bench/measure.h"
#include "bench/rivals/rival.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

using Meetings = std::vector<FacetMeeting>;

// How much time a contestant gets.
struct RaceEffort {
  double check_ms = 3000.0;  // after which frames are left out of the check, at least two being checked
  double slice_ms = 1200.0;  // after which the next one has its turn, at least two frames being timed
  double least_ms = 100.0;   // for which all frames are played again, where they are short
  int rounds = 3;
};

struct Contestant {
  std::string name;
  bool complete = true;  // promises every pair
  std::unique_ptr<Rival> rival;
  int next_frame = 0;
  double expected_ms = 0.0;
  double recall = 1.0;  // part of the pairs found
  bool correct = true;  // every pair and no other
  std::vector<double> times_ms;
};

// What is known of a contestant on a workload: times by number of threads.
struct Result {
  std::string name;
  bool correct = true;
  double recall = 1.0;
  std::vector<double> ms;

  // On as many threads or fewer: some libraries are slower on two than on one.
  double best_ms(std::size_t k) const {
    return *std::min_element(ms.begin(), ms.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  }
};

struct Row {
  NamedWorkload workload;
  double pairs = 0.0;           // median over the frames
  std::vector<Result> results;  // tact first

  // The fastest that finds every pair, at the k-th number of threads.
  const Result* fastest(std::size_t k) const {
    const Result* best = nullptr;
    for (std::size_t i = 1; i < results.size(); ++i) {
      if (results[i].correct && (!best || results[i].best_ms(k) < best->best_ms(k))) best = &results[i];
    }
    return best;
  }
  double factor(std::size_t k) const { return fastest(k) ? fastest(k)->best_ms(k) / results[0].ms[k] : 0.0; }
};

std::vector<Meetings> solve(const Workload& workload) {
  const std::unique_ptr<Rival> tact = make_tact(workload, 1);
  std::vector<Meetings> answers;
  for (int frame = 0; frame < workload.frames; ++frame) {
    tact->step(frame);
    answers.push_back(tact->meetings());
  }
  return answers;
}

void check(Contestant& contestant, const std::vector<Meetings>& answers, const RaceEffort& effort) {
  std::size_t expected = 0, found = 0, checked = 0;
  double spent = 0.0;
  for (std::size_t frame = 0; frame < answers.size(); ++frame) {
    const double start = wall_ms();
    contestant.rival->step(static_cast<int>(frame));
    contestant.expected_ms = wall_ms() - start;
    spent += contestant.expected_ms;
    const Meetings meetings = contestant.rival->meetings();
    Meetings common;
    std::set_intersection(meetings.begin(), meetings.end(), answers[frame].begin(), answers[frame].end(),
                          std::back_inserter(common));
    expected += answers[frame].size();
    found += common.size();
    contestant.correct = contestant.correct && meetings == answers[frame];
    if (++checked >= 2 && spent > effort.check_ms) break;
  }
  contestant.recall = expected == 0 ? 1.0 : static_cast<double>(found) / static_cast<double>(expected);
}

// All frames, again and again where they are short, so that what a turn begins with, caches full of other contestants'
// memory, is a small part of it; of long ones as many as fit.
void run_slice(Contestant& contestant, int frames, int threads, const RaceEffort& effort) {
  const double start = wall_ms();
  for (int k = 1;; ++k) {
    contestant.times_ms.push_back(
        time_ms(threads, contestant.expected_ms, [&] { contestant.rival->step(contestant.next_frame); }));
    contestant.next_frame = (contestant.next_frame + 1) % frames;
    const double spent = wall_ms() - start;
    if (k >= 2 && (spent > effort.slice_ms || (k % frames == 0 && spent > effort.least_ms))) return;
  }
}

std::vector<Contestant> contestants(const Workload& workload, int threads) {
  std::vector<Contestant> all;
  all.push_back({"tact", true, make_tact(workload, threads), 0, 0.0, 1.0, true, {}});
  for (const RivalKind& kind : all_rivals()) {
    all.push_back({kind.name, kind.complete, kind.make(workload, threads), 0, 0.0, 1.0, true, {}});
  }
  return all;
}

// Turns are taken so that what disturbs the machine for a while disturbs all.
void race(const Workload& workload, const std::vector<Meetings>& answers, int threads, const RaceEffort& effort,
          Row& row) {
  std::vector<Contestant> all = contestants(workload, threads);
  for (Contestant& contestant : all) check(contestant, answers, effort);
  for (int round = 0; round < effort.rounds; ++round) {
    for (Contestant& contestant : all) run_slice(contestant, workload.frames, threads, effort);
  }
  row.results.resize(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    Result& result = row.results[k];
    result.name = all[k].name;
    result.correct = result.correct && all[k].correct;
    result.recall = std::min(result.recall, all[k].recall);
    result.ms.push_back(median(all[k].times_ms));
  }
}

bool all_agree(const Row& row) {
  const std::vector<RivalKind> kinds = all_rivals();
  bool agree = row.results[0].correct;
  for (std::size_t k = 0; k < kinds.size(); ++k) agree = agree && (!kinds[k].complete || row.results[k + 1].correct);
  return agree;
}

std::string joined_ms(const Result& result) {
  std::string text;
  for (const double ms : result.ms) text += (text.empty() ? "" : " / ") + three_digits(ms);
  return text;
}

void print_row(const Row& row, const Workload& workload, const std::vector<int>& threads) {
  fmt::print("{}: {}; {} bodies, {} facets, {:.0f} facet pairs a frame\n", row.workload.name, row.workload.description,
             workload.bodies.size(), workload.facet_count(), row.pairs);
  std::string unit = "ms at";
  for (const int count : threads) unit += fmt::format("{} {}", count == threads.front() ? "" : " /", count);
  Table table({"", unit + (threads.back() == 1 ? " thread" : " threads"), "tact faster by", "pairs found"});
  for (const Result& result : row.results) {
    std::string factors;
    for (std::size_t k = 0; k < result.ms.size(); ++k) {
      factors += (k == 0 ? "" : " / ") + three_digits(result.ms[k] / row.results[0].ms[k]);
    }
    table.add({result.name, joined_ms(result), &result == &row.results[0] ? "" : factors,
               result.correct ? "all" : fmt::format("{:.2f} %", 100.0 * result.recall)});
  }
  table.print();
}

void print_summary(const std::vector<Row>& rows, const std::vector<int>& threads, const std::filesystem::path& out) {
  Table screen({"workload", "facet pairs", "fastest rival", "its ms", "tact ms", "factor", "to reach"});
  Table csv({"workload", "facet_pairs", "threads", "contestant", "ms", "pairs_found", "factor", "to_reach"});
  for (const Row& row : rows) {
    std::string names, factors, times;
    for (std::size_t k = 0; k < threads.size(); ++k) {
      const Result* fastest = row.fastest(k);
      const std::string name = fastest ? fastest->name : "none";
      if (names.find(name) == std::string::npos) names += (names.empty() ? "" : "; ") + name;
      times += (k == 0 ? "" : " / ") + (fastest ? three_digits(fastest->best_ms(k)) : std::string("-"));
      factors += (k == 0 ? "" : " / ") + three_digits(row.factor(k));
      for (const Result& result : row.results) {
        csv.add({row.workload.name, fmt::format("{:.0f}", row.pairs), fmt::to_string(threads[k]), result.name,
                 fmt::format("{:.6g}", result.ms[k]), fmt::format("{:.6g}", result.recall),
                 fmt::format("{:.4g}", result.ms[k] / row.results[0].ms[k]),
                 fmt::format("{:g}", row.workload.required_factor)});
      }
    }
    screen.add({row.workload.name, fmt::format("{:.0f}", row.pairs), names, times, joined_ms(row.results[0]), factors,
                fmt::format("{:g}", row.workload.required_factor)});
  }
  screen.print();
  if (!out.empty()) csv.write_csv(out / "rivals.csv");
}

void plot_factors(const std::vector<Row>& rows, const std::vector<int>& threads, const std::filesystem::path& out) {
  BarChart chart{.title = "tact against the fastest rival that finds every facet pair",
                 .unit = "times faster",
                 .bars = thread_names(threads),
                 .mark = "to reach",
                 .settings =
                     "set logscale y 2\nset yrange [0.25:*]\n"
                     "set arrow from graph 0, first 1 to graph 1, first 1 nohead lc rgb 'black'"};
  for (const Row& row : rows) {
    BarChart::Group group{row.workload.name, {}};
    for (std::size_t k = 0; k < threads.size(); ++k) group.values.push_back(row.factor(k));
    group.values.push_back(row.workload.required_factor);
    chart.groups.push_back(std::move(group));
  }
  plot_bars(out, "rivals", chart);
}

// FNV-1a over all answers: equal answers, equal numbers, on any machine.
std::uint64_t extended_hash(std::uint64_t hash, const std::vector<Meetings>& answers) {
  for (const Meetings& meetings : answers) {
    for (const FacetMeeting& m : meetings) {
      for (const std::int32_t number : {m.body_a, m.body_b, m.facet_a, m.facet_b}) {
        hash = (hash ^ static_cast<std::uint32_t>(number)) * 0x100000001b3u;
      }
    }
  }
  return hash;
}

double median_count(const std::vector<Meetings>& answers) {
  std::vector<double> counts;
  for (const Meetings& meetings : answers) counts.push_back(static_cast<double>(meetings.size()));
  return median(counts);
}

// Embree takes and returns large blocks in every call: the C library must not hand them back to the system each time.
void keep_freed_memory() {
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
}

}  // namespace

int run_rivals(const BenchOptions& options) {
  keep_freed_memory();
  const RaceEffort effort = options.quick ? RaceEffort{20.0, 5.0, 1.0, 1} : RaceEffort{};
  std::vector<int> threads{thread_count(options.threads)};
  if (threads[0] > 1 && !options.quick) threads.insert(threads.begin(), 1);
  fmt::print("{}\n\n", machine_line(threads.back()));
  std::vector<Row> rows;
  bool agree = true;
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const NamedWorkload& named : rival_workloads(options.quick ? Size::small : Size::full)) {
    if (!options.plays(named.name)) continue;
    const Workload workload = named.make();
    const std::vector<Meetings> answers = solve(workload);
    hash = extended_hash(hash, answers);
    Row row{named, median_count(answers), {}};
    for (const int count : threads) race(workload, answers, count, effort, row);
    print_row(row, workload, threads);
    agree = agree && all_agree(row);
    rows.push_back(std::move(row));
  }
  if (rows.empty()) options.reject_only();
  print_summary(rows, threads, options.out);
  print_answer_line(hash);
  if (!options.out.empty()) plot_factors(rows, threads, options.out);
  if (!agree) fmt::print(stderr, "tact-bench: answers differ where they must be equal\n");
  return agree ? 0 : 1;
}

}  // namespace tact::bench

#include "bench/scaling/self.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <vector>

#include "bench/answer_line.h"
#include "bench/measure.h"
#include "bench/rivals/rival.h"
#include "bench/table.h"
#include "bench/tact_runner.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

constexpr double kSelfMargin = 0.002;  // metres, for the column with contact points

struct SelfRow {
  std::string name;
  std::function<Workload()> make;
};

std::vector<SelfRow> self_rows(bool quick) {
  constexpr int kSelfFrames = 24, kQuickFrames = 6;
  if (quick) {
    return {{"cloth 3 k", [] { return cloth_alone(40, kQuickFrames); }},
            {"rolled 3 k", [] { return rolled_cloth(40, kQuickFrames); }},
            {"figure", [] { return toy_figure(kQuickFrames); }}};
  }
  return {{"cloth 13 k", [] { return cloth_alone(80, kSelfFrames); }},
          {"cloth 152 k", [] { return cloth_alone(275, kSelfFrames); }},
          {"cloth 606 k", [] { return cloth_alone(550, kSelfFrames); }},
          {"rolled 13 k", [] { return rolled_cloth(80, kSelfFrames); }},
          {"rolled 152 k", [] { return rolled_cloth(275, kSelfFrames); }},
          {"figure", [] { return toy_figure(kSelfFrames); }}};
}

// tact with contact points besides, as a contestant.
class TactWithPoints : public Rival {
 public:
  TactWithPoints(const Workload& workload, int threads)
      : runner_(workload, {.threads = threads, .outputs = {.points = true}}, TactRunner::Against::self, kSelfMargin) {}
  void step(int frame) override { report_ = &runner_.step(frame); }
  std::vector<FacetMeeting> meetings() const override { return {}; }
  const Report& report() const { return *report_; }

 private:
  TactRunner runner_;
  const Report* report_ = nullptr;
};

enum SelfContestant : std::size_t { kTact, kPoints, kEmbree, kEmbreePlain, kCgal, kContestants };

struct SelfTimes {
  std::array<double, kContestants> ms{};
  double pairs = 0.0;
  bool plain_is_right = true;
};

// Adds all answers to `answers`.
SelfTimes measure_self(const Workload& workload, const std::string& name, int threads, double budget_ms,
                       int checked_frames, tests::AnswerHash& answers) {
  auto with_points = std::make_unique<TactWithPoints>(workload, threads);
  const TactWithPoints& points = *with_points;
  const std::array<std::unique_ptr<Rival>, kContestants> all = {
      make_tact_self(workload, threads), std::move(with_points), make_embree_self(workload, threads),
      make_embree_self_plain(workload, threads), make_cgal_self(workload, threads)};
  SelfTimes times;
  std::vector<double> counts;
  for (int k = 0; k < checked_frames; ++k) {
    const int frame = k * workload.frames / checked_frames;
    for (const std::unique_ptr<Rival>& one : all) one->step(frame);
    const std::vector<FacetMeeting> own = all[kTact]->meetings();
    counts.push_back(static_cast<double>(own.size()));
    for (const FacetMeeting& m : own) {
      answers.add_feature(static_cast<std::uint32_t>(m.facet_a));
      answers.add_feature(static_cast<std::uint32_t>(m.facet_b));
    }
    for (const SelfContestant rival : {kEmbree, kCgal}) {
      if (all[rival]->meetings() != own)
        throw std::runtime_error(
            fmt::format("{}, frame {}: {} finds other pairs", name, frame, rival == kCgal ? "CGAL" : "Embree"));
    }
    times.plain_is_right = times.plain_is_right && all[kEmbreePlain]->meetings() == own;
  }
  times.pairs = median(counts);
  for (int frame = 0; frame < workload.frames; ++frame) {
    all[kPoints]->step(frame);
    answers.add(points.report());
  }
  std::array<std::vector<double>, kContestants> samples;
  int frame = 0;
  std::array<double, kContestants> expected_ms{};
  expected_ms.fill(1.0);
  for (const double start = wall_ms(); samples[0].size() < 3 || wall_ms() - start < budget_ms;
       frame = (frame + 1) % workload.frames) {
    for (std::size_t k = 0; k < kContestants; ++k) {
      expected_ms[k] = time_ms(threads, expected_ms[k], [&] { all[k]->step(frame); });
      samples[k].push_back(expected_ms[k]);
    }
  }
  for (std::size_t k = 0; k < kContestants; ++k) times.ms[k] = median(samples[k]);
  return times;
}

}  // namespace

int run_self(const BenchOptions& options) {
  mallopt(M_TRIM_THRESHOLD, 1 << 30);  // rivals.cpp says why
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  const double budget_ms = options.quick ? 20.0 : 3000.0;
  fmt::print("{}\nmedians over the frames, positions and all; points with margins of {} mm\n\n", machine_line(1),
             1e3 * kSelfMargin);
  Table table({"workload", "facets", "facet pairs", "tact ms", "and points ms", "Embree ms", "Embree, plain ms",
               "CGAL ms", "factor", "of plain"});
  std::vector<double> facets, times;  // of the cloths
  tests::AnswerHash answers;
  for (const SelfRow& row : self_rows(options.quick)) {
    if (!options.plays(row.name)) continue;
    const Workload workload = row.make();
    if (workload.bodies.empty()) continue;
    const SelfTimes m = measure_self(workload, row.name, 1, budget_ms, options.quick ? 2 : 3, answers);
    const auto count = static_cast<double>(workload.facet_count());
    if (row.name.starts_with("cloth")) {
      facets.push_back(count);
      times.push_back(m.ms[kTact]);
    }
    table.add({row.name, fmt::format("{:.0f}", count), fmt::format("{:.0f}", m.pairs), three_digits(m.ms[kTact]),
               three_digits(m.ms[kPoints]), three_digits(m.ms[kEmbree]), three_digits(m.ms[kEmbreePlain]),
               three_digits(m.ms[kCgal]), three_digits(std::min(m.ms[kEmbree], m.ms[kCgal]) / m.ms[kTact]),
               m.plain_is_right ? three_digits(m.ms[kEmbreePlain] / m.ms[kTact]) : "wrong"});
  }
  if (table.empty()) options.reject_only();
  table.print();
  if (facets.size() > 1)
    fmt::print("time of the cloths grows with facets to the power of {:.2f}\n", fitted_exponent(facets, times));
  print_answer_line(answers);
  if (!options.out.empty()) table.write_csv(options.out / "self.csv");
  return 0;
}

}  // namespace tact::bench

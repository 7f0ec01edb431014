#include "bench/scaling/queries.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/answer_line.h"
#include "bench/measure.h"
#include "bench/random.h"
#include "bench/rivals/query_rival.h"
#include "bench/scaling/many_bodies.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

class TactQueries : public QueryRival {
 public:
  TactQueries(const WorkloadBody& body, int threads) : world_({.threads = threads}) {
    id_ = world_.add_body({.positions = body.frames[0], .facets = body.facets});
  }

  void refit(const Eigen::Matrix3Xd& positions) override { world_.set_positions(id_, positions); }

  bool ask(std::span<const Ray> rays) override {
    hits_.resize(rays.size());
    world_.cast_rays(rays, hits_);
    answers_.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
      answers_[i] = {hits_[i].facet, hits_[i].fraction * (rays[i].to - rays[i].from).norm()};
    return true;
  }

  void ask(std::span<const PointQuery> points) override {
    closest_.resize(points.size());
    world_.closest_points(points, closest_);
    answers_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) answers_[i] = {closest_[i].facet, closest_[i].distance};
  }

  const std::vector<QueryAnswer>& answers() const override { return answers_; }
  std::span<const RayHit> hits() const { return hits_; }
  std::span<const ClosestPoint> closest() const { return closest_; }

 private:
  World world_;
  BodyId id_;
  std::vector<RayHit> hits_;
  std::vector<ClosestPoint> closest_;
  std::vector<QueryAnswer> answers_;
};

enum QueryContestant : std::size_t { kQueryTact, kQueryEmbree, kQueryFcl, kQueryContestants };
enum class QueryKind { refit_alone, rays, points };
constexpr std::array<const char*, 3> kQueryNames{"refit alone", "rays", "nearest points"};

// Floats are rounded at 6e-8 of the size of the bodies, which is 1 m, a few times over.
constexpr double kFloatDifference = 1e-5, kDoubleDifference = 1e-9;  // of the distance or 1 m, whichever is more
// Of all answers, as many may differ from Embree's, which takes rays along the border of what is seen for hits or not.
constexpr double kMostDiffering = 0.001;

struct QuerySet {
  std::vector<Ray> rays;
  std::vector<PointQuery> points;
};

// Rays from all around, a fifth of which miss; points in a cube of three metres about the body.
QuerySet queries_about(const Eigen::Vector3d& middle, int count) {
  Random random(61);
  QuerySet set;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d from = middle + 2.5 * random.direction();
    const Eigen::Vector3d through = middle + 1.2 * std::cbrt(random.uniform(0.0, 1.0)) * random.direction();
    set.rays.push_back({from, from + 2.0 * (through - from)});
    const double x = random.uniform(-1.5, 1.5), y = random.uniform(-1.5, 1.5), z = random.uniform(-1.5, 1.5);
    set.points.push_back({.point = middle + Eigen::Vector3d(x, y, z)});
  }
  return set;
}

// How many answers are others.
std::int64_t differing(const std::vector<QueryAnswer>& own, const std::vector<QueryAnswer>& other, double tolerance) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const bool same_kind = (own[i].facet < 0) == (other[i].facet < 0);
    const double allowed = tolerance * std::max(1.0, own[i].distance);
    count += !same_kind || (own[i].facet >= 0 && !(std::abs(own[i].distance - other[i].distance) <= allowed));
  }
  return count;
}

class QueryContest {
 public:
  QueryContest(const WorkloadBody& body, int threads, double budget_ms)
      : body_(body), threads_(threads), budget_ms_(budget_ms) {
    auto tact = std::make_unique<TactQueries>(body, threads);
    tact_ = tact.get();
    all_ = {std::move(tact), make_embree_queries(body, threads), make_fcl_queries(body, threads)};
  }

  // With one thread the answers are added to `all_answers`.
  void add_row(QueryKind kind, int count, Table& table, tests::AnswerHash& all_answers) {
    const QuerySet set = queries_about(body_.frames[0].rowwise().mean(), count);
    std::array<bool, kQueryContestants> answers{};
    for (std::size_t k = 0; k < kQueryContestants; ++k) answers[k] = step(k, kind, set, 1);
    if (threads_ == 1 && kind == QueryKind::rays) all_answers.add(tact_->hits());
    if (threads_ == 1 && kind == QueryKind::points) all_answers.add(tact_->closest());
    const auto check = [&](QueryContestant rival, double tolerance) {
      return answers[rival] && kind != QueryKind::refit_alone
                 ? differing(all_[kQueryTact]->answers(), all_[rival]->answers(), tolerance)
                 : 0;
    };
    const std::int64_t from_embree = check(kQueryEmbree, kFloatDifference);
    const std::int64_t from_fcl = check(kQueryFcl, kDoubleDifference);
    if (from_fcl > 0) throw std::runtime_error(fmt::format("{} answers of FCL differ", from_fcl));
    if (static_cast<double>(from_embree) > kMostDiffering * count)
      throw std::runtime_error(fmt::format("{} of {} answers of Embree differ", from_embree, count));

    std::array<double, kQueryContestants> ms{};
    for (std::size_t k = 0; k < kQueryContestants; ++k) {
      if (answers[k]) ms[k] = median_ms(k, kind, set);
    }
    const double rival = answers[kQueryFcl] ? std::min(ms[kQueryEmbree], ms[kQueryFcl]) : ms[kQueryEmbree];
    table.add({kQueryNames[static_cast<std::size_t>(kind)], fmt::to_string(body_.facets.cols()), fmt::to_string(count),
               fmt::to_string(threads_), three_digits(ms[kQueryTact]), three_digits(ms[kQueryEmbree]),
               answers[kQueryFcl] ? three_digits(ms[kQueryFcl]) : "-", three_digits(rival / ms[kQueryTact]),
               fmt::to_string(from_embree)});
  }

 private:
  bool step(std::size_t k, QueryKind kind, const QuerySet& set, int frame) {
    all_[k]->refit(body_.positions(frame));
    if (kind == QueryKind::rays) return all_[k]->ask(set.rays);
    if (kind == QueryKind::points) all_[k]->ask(set.points);
    return true;
  }

  double median_ms(std::size_t k, QueryKind kind, const QuerySet& set) {
    std::vector<double> times;
    double expected = kShortWork_ms;
    const double start = wall_ms();
    // Three rounds at least, or as many as take ten times the budget.
    const auto goes_on = [&](int round) {
      const double spent = wall_ms() - start;
      return spent < budget_ms_ || (round < 3 && spent < 10.0 * budget_ms_);
    };
    for (int round = 0; goes_on(round); ++round) {
      const int frame = round % static_cast<int>(body_.frames.size());
      expected = time_ms(threads_, expected, [&] { step(k, kind, set, frame); });
      times.push_back(expected);
    }
    return median(times);
  }

  const WorkloadBody& body_;
  int threads_;
  double budget_ms_;
  const TactQueries* tact_ = nullptr;  // the first of them
  std::array<std::unique_ptr<QueryRival>, kQueryContestants> all_;
};

}  // namespace

int run_queries(const BenchOptions& options) {
  const int threads = thread_count(options.threads);
  fmt::print("{}\n\n", machine_line(threads));
  // 20 f² facets each.
  const std::vector<int> frequencies = options.quick ? std::vector{6} : std::vector{22, 71, 224};
  const std::vector<int> none{0};
  const std::vector<int> counts = options.quick ? std::vector{100, 1000} : std::vector{100, 1'000, 10'000, 100'000};
  constexpr int kQueryFrames = 4;
  Table table({"queries", "facets", "a step", "threads", "tact ms", "Embree ms", "FCL ms", "rival / tact",
               "differ from Embree"});
  tests::AnswerHash answers;
  for (const int frequency : frequencies) {
    const Workload workload = large_pair(frequency, kQueryFrames);
    for (int t = 1; t <= threads; t *= 2) {
      QueryContest contest(workload.bodies[0], t, options.quick ? 5.0 : 200.0);
      for (const QueryKind kind : {QueryKind::refit_alone, QueryKind::rays, QueryKind::points}) {
        if (!options.plays(kQueryNames[static_cast<std::size_t>(kind)])) continue;
        for (const int count : kind == QueryKind::refit_alone ? none : counts)
          contest.add_row(kind, count, table, answers);
      }
    }
  }
  const bool many_bodies = options.plays("nearest points of many bodies");
  if (table.empty() && !many_bodies) options.reject_only();
  if (!table.empty()) table.print();
  if (many_bodies) measure_many_bodies(options);
  print_answer_line(answers);
  if (!options.out.empty() && !table.empty()) table.write_csv(options.out / "queries.csv");
  return 0;
}

}  // namespace tact::bench

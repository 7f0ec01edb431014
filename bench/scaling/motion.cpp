#include "bench/scaling/motion.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "bench/answer_line.h"
#include "bench/measure.h"
#include "bench/rivals/inclusion.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"
#include "narrowphase/motion/meeting.h"
#include "tests/support/data/unit_queries.h"

namespace tact::bench {
namespace {

constexpr double kHalfTurn = 0.2553;  // the tangent of a quarter: half a radian

// A workload whose bodies go from frame to frame in leaps of several frames, and back.
struct Leaps {
  std::string name;
  std::function<Workload()> make;
  int frames;  // a leap
};

// The same, carried along as a whole, fixed bodies too: in `leap` frames by a way, and turned about an axis along z
// through the origin by twice the angle of tangent `half_turn`. Sums, products and quotients alone: the same bits
// everywhere.
Workload carried(Workload workload, int leap, const Eigen::Vector3d& way, double half_turn) {
  for (WorkloadBody& body : workload.bodies) {
    if (body.fixed()) body.frames.resize(static_cast<std::size_t>(workload.frames), body.frames[0]);
    for (std::size_t frame = 0; frame < body.frames.size(); ++frame) {
      const double part = static_cast<double>(frame) / leap, q = part * half_turn, s = 1.0 + q * q;
      Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
      turn.topLeftCorner<2, 2>() << (1.0 - q * q) / s, -2.0 * q / s, 2.0 * q / s, (1.0 - q * q) / s;
      body.frames[frame] = ((turn * body.frames[frame]).colwise() + part * way).eval();
    }
  }
  return workload;
}

struct Measured {
  double ms = 0.0;
  MotionStats stats;
};

// Bodies of a workload on their way from the first frame to another.
class MotionRunner {
 public:
  MotionRunner(const Workload& workload, int to, int threads)
      : workload_(workload), world_({.threads = threads}), to_(to) {
    for (const WorkloadBody& body : workload.bodies) {
      ids_.push_back(world_.add_body({.positions = body.frames[0],
                                      .facets = body.facets,
                                      .surface = body.surface,
                                      .motion = body.fixed() ? Motion::fixed : Motion::deformable,
                                      .mask = body.mask}));
    }
  }
  // A step at the first frame, and the positions of the other one.
  void go() {
    set(0);
    world_.detect();
    set(to_);
  }
  const MotionReport& detect(Impacts wanted) { return world_.detect_motion(wanted); }
  // After a step, of all on the whole way, and then on a half, a quarter and an eighth of it: how long it takes without
  // positions, in parts of the first call.
  double line_search() {
    double first = 0.0, all = 0.0;
    go();
    for (const double part : {1.0, 0.5, 0.25, 0.125}) {
      for (std::size_t i = 0; i < ids_.size(); ++i) {
        const WorkloadBody& body = workload_.bodies[i];
        if (body.fixed()) continue;
        const Eigen::Matrix3Xd &begin = body.positions(0), &end = body.positions(to_);
        world_.set_positions(ids_[i], begin + part * (end - begin));
      }
      all += time_ms(1, 1.0, [&] { world_.detect_motion(); });
      if (part == 1.0) first = all;
    }
    return all / first;
  }

 private:
  void set(int frame) {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (!workload_.bodies[i].fixed()) world_.set_positions(ids_[i], workload_.bodies[i].positions(frame));
    }
  }
  const Workload& workload_;
  World world_;
  std::vector<BodyId> ids_;
  int to_;
};

// The first call after a step, time and again.
Measured measure(MotionRunner& runner, Impacts wanted, int threads, double budget_ms) {
  std::vector<double> times;
  Measured result;
  double expected_ms = 0.0;
  for (const double start = wall_ms(); times.size() < 3 || wall_ms() - start < budget_ms;) {
    runner.go();
    times.push_back(time_ms(threads, expected_ms, [&] { result.stats = runner.detect(wanted).stats(); }));
    expected_ms = times.back();
  }
  result.ms = median(times);
  return result;
}

// The impacts of all kinds, which must not depend on the number of threads, are added to `answers`.
void add_answers(MotionRunner& one, MotionRunner& several, const std::string& name, tests::AnswerHash& answers) {
  for (const Impacts wanted : {Impacts::all, Impacts::first_of_pair, Impacts::first}) {
    tests::AnswerHash of_one, of_several;
    of_one.add(one.detect(wanted));
    of_several.add(several.detect(wanted));
    if (of_one.hashes() != of_several.hashes())
      throw std::runtime_error(fmt::format("motion of {}: the answers depend on the number of threads", name));
    answers.add(one.detect(wanted));
  }
}

// Scenes as they move from one step to the next, and carried along as a whole.
std::vector<Leaps> leaps_of(bool quick) {
  const auto on_sphere = [=] { return cloth(quick ? 16 : 80, 24); };
  const auto blobs = [=] { return pile(quick ? 27 : 500, 4, 24); };
  const auto in_layers = [=] { return layers(quick ? 3 : 20, quick ? 12 : 60, 24); };
  const auto apart = [=] { return scattered(quick ? 60 : 2000, 24); };
  const auto carry = [](const char* name, const auto& make, int frames, const Eigen::Vector3d& way, double turn) {
    return Leaps{name, [=] { return carried(make(), frames, way, turn); }, frames};
  };
  return {{"cloth on a sphere", on_sphere, 3},
          {"a pile of blobs of 320", blobs, 3},
          {"layers of cloth", in_layers, 3},
          {"blobs on a terrain", [=] { return terrain(quick ? 24 : 120, quick ? 20 : 200, 24); }, 3},
          {"scattered blobs of 80", apart, 6},
          {"two blobs of 20,480", [=] { return large_pair(quick ? 8 : 32, 24); }, 3},
          {"a chain of rings", [=] { return chain(quick ? 8 : 60, 24); }, 3},
          carry("cloth on a sphere, carried by its size", on_sphere, 3, {1.5, 2.5, 3.0}, 0.0),
          carry("cloth on a sphere, turned by 0.5", on_sphere, 3, {0, 0, 0}, kHalfTurn),
          carry("layers of cloth, carried by their size", in_layers, 3, {1.5, 2.5, 3.0}, 0.0),
          carry("scattered blobs of 80, carried far", apart, 6, {60, 40, 90}, 0.0),
          carry("scattered blobs of 80, turned by 0.5", apart, 6, {0, 0, 0}, kHalfTurn),
          carry("a pile of blobs of 320, turned by 0.5", blobs, 3, {0, 0, 0}, kHalfTurn)};
}

Table measure_leaps(const std::vector<Leaps>& all, const BenchOptions& options, int threads, double budget_ms,
                    tests::AnswerHash& answers) {
  Table table({"workload", "facets", "pairs of bodies", "candidates", "left by the filter %", "impacts", "1 thread ms",
               fmt::format("{} threads ms", threads), "first only ms", "ns a candidate", "line search of 4"});
  for (const Leaps& leaps : all) {
    if (!options.plays(leaps.name)) continue;
    const Workload workload = leaps.make();
    MotionRunner one(workload, leaps.frames, 1), several(workload, leaps.frames, threads);
    one.go();
    several.go();
    add_answers(one, several, leaps.name, answers);
    const auto [ms, stats] = measure(one, Impacts::all, 1, budget_ms);
    const double first_ms = measure(one, Impacts::first, 1, budget_ms).ms;
    const double several_ms = measure(several, Impacts::all, threads, budget_ms).ms;
    std::vector<double> searches;
    for (int k = 0; k < 3; ++k) searches.push_back(one.line_search());
    const auto candidates = static_cast<double>(std::max<std::int64_t>(stats.candidates, 1));
    table.add({leaps.name, fmt::to_string(workload.facet_count()), fmt::to_string(stats.body_pairs),
               fmt::to_string(stats.candidates), three_digits(100.0 * static_cast<double>(stats.searched) / candidates),
               fmt::to_string(stats.impacts), three_digits(ms), three_digits(several_ms), three_digits(first_ms),
               three_digits(1e6 * ms / candidates), three_digits(median(searches))});
  }
  return table;
}

// Two of a kind that fly at each other.
struct Couple {
  MovingShape a, b;
};

Couple couple_of(int frequency) {
  const Shape ball = geodesic_sphere(frequency);
  Couple couple{{ball, ball.positions}, {ball, ball.positions}};
  couple.b.begin.positions.colwise() += Eigen::Vector3d(2.05, 0.1, 0.2);
  couple.b.end = couple.b.begin.positions;
  couple.a.end.colwise() += Eigen::Vector3d(0.3, 0.0, 0.05);
  for (Eigen::Index v = 0; v < couple.b.end.cols(); ++v)
    couple.b.end.col(v) +=
        0.02 * Eigen::Vector3d(wave(0.37 * static_cast<double>(v)), wave(0.11 * static_cast<double>(v)), 0);
  return couple;
}

using Key = std::tuple<FeaturePair, std::array<int, 3>, std::array<int, 3>>;

// Are the impacts those of the rival? It tells times to 1e-6 of a unit of length, and may report what comes as near.
void check_against_rival(const MotionReport& report, const InclusionResult& rival) {
  std::map<Key, double> times;
  for (const InclusionImpact& impact : rival.impacts) times[{impact.kind, impact.a, impact.b}] = impact.time;
  std::size_t missed = 0;
  for (const Impact& impact : report.impacts()) {
    const auto found = times.find({impact.kind, impact.a_vertices, impact.b_vertices});
    if (found == times.end() || std::abs(found->second - impact.time) > 1e-4) ++missed;
  }
  const std::size_t more = times.size() - (report.impacts().size() - missed);
  if (missed > 0 || more > 1 + times.size() / 100)
    throw std::runtime_error(fmt::format("motion: {} impacts of {} are none of the rival's, which has {} more", missed,
                                         report.impacts().size(), more));
}

Table measure_growth(bool quick, double budget_ms, tests::AnswerHash& answers) {
  Table table({"two spheres", "candidates", "impacts", "tact ms", "inclusion ms", "factor", "ns a candidate"});
  std::vector<double> facets, times;
  for (const int frequency : quick ? std::vector{4, 8} : std::vector{8, 16, 32, 64, 128}) {
    const Couple couple = couple_of(frequency);
    World world({.threads = 1});
    const BodyId a = world.add_body({.positions = couple.a.begin.positions, .facets = couple.a.begin.facets});
    const BodyId b = world.add_body({.positions = couple.b.begin.positions, .facets = couple.b.begin.facets});
    const auto go = [&] {
      world.set_positions(a, couple.a.begin.positions);
      world.set_positions(b, couple.b.begin.positions);
      world.detect();
      world.set_positions(a, couple.a.end);
      world.set_positions(b, couple.b.end);
    };
    go();
    answers.add(world.detect_motion());
    const bool with_rival = frequency <= 32;
    double rival_ms = 0.0;
    if (with_rival) {
      InclusionResult rival;
      rival_ms = time_ms(1, 1.0, [&] { rival = find_by_inclusion(couple.a, couple.b); });
      check_against_rival(world.detect_motion(), rival);
    }
    std::vector<double> all;
    for (const double start = wall_ms(); all.size() < 3 || wall_ms() - start < budget_ms;) {
      go();
      all.push_back(time_ms(1, 1.0, [&] { world.detect_motion(); }));
    }
    const MotionStats stats = world.detect_motion().stats();
    const double ms = median(all);
    facets.push_back(static_cast<double>(stats.candidates));
    times.push_back(ms);
    table.add({fmt::format("{} facets each", couple.a.begin.facets.cols()), fmt::to_string(stats.candidates),
               fmt::to_string(stats.impacts), three_digits(ms), with_rival ? three_digits(rival_ms) : "-",
               with_rival ? three_digits(rival_ms / ms) : "-",
               three_digits(1e6 * ms / static_cast<double>(stats.candidates))});
  }
  fmt::print("time grows as the number of candidates to the power of {:.2f}\n\n", fitted_exponent(facets, times));
  return table;
}

// Queries of ../shared/data, one by one and without the filter.
void measure_queries() {
  const std::string folder = "../shared/data/ccd_unit_queries";
  narrowphase::MeetingSearch search;
  std::vector<narrowphase::MovingPolygon> polygons;
  std::size_t right = 0;
  for (const tests::UnitQuery& query : tests::read_unit_queries(folder)) {
    polygons.push_back(query.polygon());
    right += (search.first(polygons.back(), 0.0).time <= 1.0) == query.answer;
  }
  if (polygons.empty()) {
    fmt::print("no unit queries at {}: they are left out\n\n", folder);
    return;
  }
  std::vector<double> times;
  for (int k = 0; k < 20; ++k) {
    times.push_back(time_ms(1, 1.0, [&] {
      for (const narrowphase::MovingPolygon& polygon : polygons) search.first(polygon, 0.0);
    }));
  }
  fmt::print("{} unit queries, {} right, {} us each without the filter\n\n", polygons.size(), right,
             three_digits(1e3 * median(times) / static_cast<double>(polygons.size())));
}

}  // namespace

int run_motion(const BenchOptions& options) {
  const int threads = thread_count(options.threads);
  const double budget_ms = options.quick ? 20.0 : 1000.0;
  fmt::print("{}\n\n", machine_line(threads));
  measure_queries();
  const bool quick = options.quick;
  tests::AnswerHash answers;
  const Table leaps = measure_leaps(leaps_of(quick), options, threads, budget_ms, answers);
  if (leaps.empty()) options.reject_only();
  leaps.print();
  if (!options.only.empty()) {
    print_answer_line(answers);
    return 0;
  }
  const Table growth = measure_growth(quick, budget_ms, answers);
  growth.print();
  print_answer_line(answers);
  if (!options.out.empty()) {
    leaps.write_csv(options.out / "motion.csv");
    growth.write_csv(options.out / "motion_growth.csv");
  }
  return 0;
}

}  // namespace tact::bench

#include "bench/scaling/solver.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/answer_line.h"
#include "bench/measure.h"
#include "bench/rivals/near_points.h"
#include "bench/scaling/points.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

struct SolverRow {
  std::string name;
  std::function<Workload()> make;
};

// A recorded scene in which all that moves is held against itself.
Workload recorded_with_self(const std::string& scene, int size, int settled, int frames) {
  Workload workload = recorded(scene, size, settled, frames);
  for (WorkloadBody& body : workload.bodies) body.self_contact = !body.fixed();
  return workload;
}

// Substeps: a 200th of the way from pose to pose.
Workload slow_toy(int frames) {
  Workload workload = toy_figure(frames, frames / 4000.0);
  if (workload.bodies.empty()) return workload;
  WorkloadBody& body = workload.bodies[0];
  const Eigen::Matrix3Xd& x = body.positions(0);
  body.margin = 0.005 * (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
  body.self_contact = true;
  return workload;
}

// Substeps: a 400th of a walk's period.
Workload slow_garment(int frames) {
  Workload workload = garment(20'000, 400);
  for (WorkloadBody& body : workload.bodies) {
    body.margin = 0.002;
    if (body.fixed()) continue;
    body.self_contact = true;
    for (int frame = 0; frame < frames; ++frame)
      body.frames[static_cast<std::size_t>(frame)] = body.positions(std::min(frame, frames - frame));
    body.frames.resize(static_cast<std::size_t>(frames));
  }
  workload.frames = frames;
  return workload;
}

std::vector<SolverRow> solver_rows(bool quick) {
  const int frames = quick ? 4 : 16;
  std::vector<SolverRow> rows;
  const auto add = [&](std::string name, std::function<Workload()> make) {
    rows.push_back({std::move(name), std::move(make)});
  };
  for (const int side : quick ? std::vector{12} : std::vector{64, 128}) {
    const std::string size = fmt::format(" {}²", side);
    add("cloth at rest" + size, [=] { return cloth_on_ball(side, quick ? 40 : 1500, frames); });
    add("cloth falling" + size, [=] { return cloth_on_ball(side, quick ? 10 : 150, frames); });
  }
  if (!quick) {
    add("cloth-over-sphere", [=] { return recorded_with_self("cloth-over-sphere", 64, 300, frames); });
    add("cloth-fold", [=] { return recorded_with_self("cloth-fold", 48, 300, frames); });
    add("pile", [=] { return recorded("pile", 100, 300, frames); });
    add("toy poses", [=] { return slow_toy(frames); });
    add("garment", [=] { return slow_garment(frames); });
  }
  add("sheets in a wave", [=] { return waving_sheets(quick ? 3 : 50, quick ? 10 : 70, quick ? 4 : 8); });
  return rows;
}

std::vector<double> margins_of_solver(const Workload& workload) {
  std::vector<double> margins;
  for (const WorkloadBody& body : workload.bodies) margins.push_back(body.margin);
  return margins;
}

// A workload with margins and self-contact through tact.
class SolverWorld {
 public:
  SolverWorld(const Workload& workload, Outputs outputs, int threads)
      : workload_(workload), world_({.threads = threads, .outputs = outputs}) {
    for (const WorkloadBody& body : workload.bodies) {
      ids_.push_back(world_.add_body({.positions = body.positions(0),
                                      .facets = body.facets,
                                      .surface = body.surface,
                                      .motion = body.fixed() ? Motion::fixed : Motion::deformable,
                                      .mask = body.mask,
                                      .margin = body.margin,
                                      .self_contact = body.self_contact}));
    }
    world_.detect();
  }
  const Report& step(int frame) {
    set(frame, 1.0);
    return world_.detect();
  }
  // What meets on the way, and the step.
  void motion(int frame) {
    set(frame, 1.0);
    world_.detect_motion();
    world_.detect();
  }
  // The step, half of it, a quarter and an eighth, as a line search tries them from the frame before.
  void search(int frame) {
    for (double part = 1.0; part > 0.1; part *= 0.5) {
      set(frame, part);
      world_.detect();
    }
  }

 private:
  void set(int frame, double part) {
    updates_.clear();
    tried_.clear();
    tried_.reserve(ids_.size());
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      const WorkloadBody& body = workload_.bodies[k];
      if (body.fixed()) continue;
      if (part < 1.0) {
        const int before = (frame + workload_.frames - 1) % workload_.frames;
        tried_.push_back((1.0 - part) * body.positions(before) + part * body.positions(frame));
      }
      updates_.push_back({ids_[k], part < 1.0 ? tried_.back() : body.positions(frame)});
    }
    world_.set_positions(updates_);
  }

  const Workload& workload_;
  World world_;
  std::vector<BodyId> ids_;
  std::vector<PositionsUpdate> updates_;
  std::vector<Eigen::Matrix3Xd> tried_;
};

// Medians over the frames, ms; each takes its turn in every frame.
struct SolverTimes {
  enum Column { without, without_on_two, with, with_on_two, within_reach, search, motion, rival, kCount };
  std::array<std::vector<double>, kCount> ms;
  std::vector<double> points;

  double median_of(Column column) const { return median(ms[column]); }
};

// Each frame with two threads has the same points, and the first two have the rival's.
void check_solver(const Workload& workload, const std::string& name, tests::AnswerHash& answers) {
  SolverWorld one(workload, {.points = true}, 1), two(workload, {.points = true}, 2);
  const auto rival = make_near_embree(workload, margins_of_solver(workload));
  for (int frame = 0; frame < workload.frames; ++frame) {
    const Report& report = one.step(frame);
    tests::AnswerHash of_one, of_two;
    of_one.add(report);
    of_two.add(two.step(frame));
    if (of_one.hashes() != of_two.hashes()) throw std::runtime_error(name + ": two threads find other points");
    answers.add(report);
    if (frame >= 2) continue;
    rival->step(frame);
    check_against_rival(report, rival->points(), name);
  }
}

SolverTimes measure_solver(const Workload& workload, double budget_ms) {
  SolverWorld without(workload, {}, 1), without_on_two(workload, {}, 2), with(workload, {.points = true}, 1),
      with_on_two(workload, {.points = true}, 2), within_reach(workload, {.within_reach = true}, 1),
      search(workload, {.within_reach = true}, 1), motion(workload, {}, 1);
  const auto rival = make_near_embree(workload, margins_of_solver(workload));
  SolverTimes times;
  int frame = 0;
  double expected_ms = 1.0;
  for (const double start = wall_ms(); times.points.size() < 4 || wall_ms() - start < budget_ms;
       frame = (frame + 1) % workload.frames) {
    const auto time = [&](SolverTimes::Column column, int threads, const auto& work) {
      times.ms[column].push_back(time_ms(threads, expected_ms, work));
      expected_ms = times.ms[column].back();
    };
    time(SolverTimes::without, 1, [&] { without.step(frame); });
    time(SolverTimes::without_on_two, 2, [&] { without_on_two.step(frame); });
    time(SolverTimes::with, 1, [&] { times.points.push_back(static_cast<double>(with.step(frame).stats().points)); });
    time(SolverTimes::with_on_two, 2, [&] { with_on_two.step(frame); });
    time(SolverTimes::within_reach, 1, [&] { within_reach.step(frame); });
    time(SolverTimes::search, 1, [&] { search.search(frame); });
    time(SolverTimes::motion, 1, [&] { motion.motion(frame); });
    time(SolverTimes::rival, 1, [&] { rival->step(frame); });
  }
  return times;
}

}  // namespace

int run_solver(const BenchOptions& options) {
  fmt::print(
      "{}\nsubsteps of solvers: margins and self-contact; one thread but where two are named, medians over the frames, "
      "ms\n\n",
      machine_line(1));
  Table table({"workload", "facets", "points", "without", "on two", "with points", "on two", "ratio", "ns a point",
               "all within reach", "line search of four", "and motion", "Embree's boxes", "factor"});
  double logarithms = 0.0, least = 0.0;
  int rows = 0;
  tests::AnswerHash answers;
  for (const SolverRow& row : solver_rows(options.quick)) {
    if (!options.plays(row.name)) continue;
    fmt::print(stderr, "{}\n", row.name);
    const Workload workload = row.make();
    if (workload.bodies.empty()) continue;
    check_solver(workload, row.name, answers);
    const SolverTimes m = measure_solver(workload, options.quick ? 1.0 : 3000.0);
    const double without = m.median_of(SolverTimes::without), with = m.median_of(SolverTimes::with),
                 points = median(m.points), factor = m.median_of(SolverTimes::rival) / with;
    logarithms += std::log(factor);
    least = rows++ == 0 ? factor : std::min(least, factor);
    table.add({row.name, std::to_string(workload.facet_count()), fmt::format("{:.0f}", points), three_digits(without),
               three_digits(m.median_of(SolverTimes::without_on_two)), three_digits(with),
               three_digits(m.median_of(SolverTimes::with_on_two)), three_digits(with / without),
               points > 0.0 ? three_digits(1e6 * (with - without) / points) : "-",
               three_digits(m.median_of(SolverTimes::within_reach)), three_digits(m.median_of(SolverTimes::search)),
               three_digits(m.median_of(SolverTimes::motion)), three_digits(m.median_of(SolverTimes::rival)),
               three_digits(factor)});
  }
  if (table.empty()) options.reject_only();
  table.print();
  if (rows > 0)
    fmt::print("\nfactor against Embree's boxes: {} in the geometric mean, {} in the worst row\n",
               three_digits(std::exp(logarithms / rows)), three_digits(least));
  print_answer_line(answers);
  if (!options.out.empty()) table.write_csv(options.out / "solver.csv");
  return 0;
}

}  // namespace tact::bench

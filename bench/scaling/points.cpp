#include "bench/scaling/points.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/answer_line.h"
#include "bench/measure.h"
#include "bench/rivals/near_points.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"

namespace tact::bench {
namespace {

constexpr double kMarginOfPoints = 0.005;  // of a body's size, where it has none of its scene

std::vector<double> margins_of(const Workload& workload) {
  std::vector<double> margins;
  for (const WorkloadBody& body : workload.bodies) {
    const Eigen::Matrix3Xd& x = body.positions(0);
    const double size = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
    margins.push_back(body.margin > 0.0 ? body.margin : kMarginOfPoints * size);
  }
  return margins;
}

// A workload with margins through tact.
class PointRunner {
 public:
  PointRunner(const Workload& workload, const std::vector<double>& margins, Outputs outputs)
      : workload_(workload), world_({.threads = 1, .outputs = outputs}) {
    for (std::size_t k = 0; k < workload.bodies.size(); ++k) {
      const WorkloadBody& body = workload.bodies[k];
      ids_.push_back(world_.add_body({.positions = body.positions(0),
                                      .facets = body.facets,
                                      .surface = body.surface,
                                      .motion = body.fixed() ? Motion::fixed : Motion::deformable,
                                      .mask = body.mask,
                                      .margin = margins[k]}));
    }
  }
  const Report& step(int frame) {
    updates_.clear();
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      if (!workload_.bodies[k].fixed()) updates_.push_back({ids_[k], workload_.bodies[k].positions(frame)});
    }
    world_.set_positions(updates_);
    return world_.detect();
  }

 private:
  const Workload& workload_;
  World world_;
  std::vector<BodyId> ids_;
  std::vector<PositionsUpdate> updates_;
};

std::size_t count_points(const Report& report) {
  std::size_t count = 0;
  for (const Contact& contact : report.contacts()) count += contact.points().size();
  return count;
}

// The vertices that are inside a closed body are the rival's. tact's way out leads to the side that the vertex came
// from, so it is no shorter than the distance to the surface. What lies on the surface but for rounding may be either.
void check_signs(const Report& report, const Workload& workload, const std::vector<CrossedVertex>& rival,
                 const std::string& name) {
  constexpr double kOnSurface = 1e-9;  // metres
  std::vector<CrossedVertex> own;
  for (const Contact& contact : report.contacts()) {
    if (contact.facet_pairs().empty()) continue;
    const auto a = static_cast<int>(contact.a.index), b = static_cast<int>(contact.b.index);
    for (const ContactPoint& point : contact.points()) {
      if (point.gap > -kOnSurface || point.kind == FeaturePair::edge_edge) continue;
      const bool of_a = point.kind == FeaturePair::vertex_facet;
      if (workload.bodies[of_a ? b : a].surface == Surface::closed)
        own.push_back({a, b, point.kind, (of_a ? point.a_vertices : point.b_vertices)[0], -point.gap});
    }
  }
  std::ranges::sort(own, {}, &CrossedVertex::key);
  const auto fail = [&](const CrossedVertex& one, const char* what) {
    throw std::runtime_error(fmt::format("signs of {}: of bodies {} and {}, vertex {} of the {}, {} m deep, {}", name,
                                         one.body_a, one.body_b, one.vertex,
                                         one.kind == FeaturePair::vertex_facet ? "first" : "second", one.depth, what));
  };
  std::size_t place = 0;
  for (const CrossedVertex& one : rival) {
    if (place < own.size() && own[place].key() < one.key()) fail(own[place], "is not inside for the rival");
    if (place < own.size() && own[place].key() == one.key()) {
      if (own[place].depth < one.depth - kOnSurface) fail(one, "is less deep for tact");
      ++place;
    } else if (one.depth > 2.0 * kOnSurface) {
      fail(one, "is not inside for tact");
    }
  }
  if (place != own.size()) fail(own[place], "is not inside for the rival");
}

bool any_cross(const Report& report) {
  return std::ranges::any_of(report.contacts(), [](const Contact& contact) { return !contact.facet_pairs().empty(); });
}

// Medians over the frames, all contestants taking turns, so that what disturbs one disturbs all.
struct PointTimes {
  double without = 0.0, with = 0.0, with_patches = 0.0, embree = 0.0, cgal = 0.0, signs = 0.0;  // ms
  double points = 0.0;
  bool crosses = false;  // or there is nothing that has a sign

  double fastest() const { return std::min(embree, cgal); }
};

// Adds all answers to `answers`.
PointTimes measure(const Workload& workload, const std::string& name, bool quick, tests::AnswerHash& answers) {
  const double budget_ms = quick ? 0.0 : 3000.0;
  const std::size_t least_rounds = quick ? 1 : 3;
  const std::vector<double> margins = margins_of(workload);
  PointRunner without(workload, margins, {}), with(workload, margins, {.points = true}),
      with_patches(workload, margins, {.patches = true, .points = true});
  const auto embree = make_near_embree(workload, margins), cgal = make_near_cgal(workload, margins),
             signs = make_signed_embree(workload, margins);
  PointTimes result;
  for (int frame = 0; frame < std::min(2, workload.frames); ++frame) {
    const Report& report = with.step(frame);
    embree->step(frame);
    cgal->step(frame);
    check_against_rival(report, embree->points(), name + " by Embree");
    check_against_rival(report, cgal->points(), name + " by CGAL");
    signs->step(frame);
    check_signs(report, workload, signs->crossed(), name);
    result.crosses |= any_cross(report);
    answers.add(report);
    answers.add(without.step(frame));
  }
  for (int frame = 0; frame < workload.frames; ++frame) answers.add(with_patches.step(frame));
  std::vector<double> times[6], points;
  int frame = 0;
  double expected_ms = 1.0;
  for (const double start = wall_ms(); times[0].size() < least_rounds || wall_ms() - start < budget_ms;
       frame = (frame + 1) % workload.frames) {
    const auto time = [&](std::size_t k, const auto& work) {
      times[k].push_back(time_ms(1, expected_ms, work));
      expected_ms = times[k].back();
    };
    time(0, [&] { without.step(frame); });
    time(1, [&] { points.push_back(static_cast<double>(count_points(with.step(frame)))); });
    time(2, [&] { with_patches.step(frame); });
    time(3, [&] { embree->step(frame); });
    time(4, [&] { cgal->step(frame); });
    if (result.crosses) time(5, [&] { signs->step(frame); });
  }
  result.without = median(times[0]);
  result.with = median(times[1]);
  result.with_patches = median(times[2]);
  result.embree = median(times[3]);
  result.cgal = median(times[4]);
  result.signs = result.crosses ? median(times[5]) : result.fastest();
  result.points = median(points);
  return result;
}

}  // namespace

// Of bodies that do not cross, the points are the rival's, but for ties of what touches. Where they cross, tact has
// signs besides: those of its points that have not crossed are the rival's.
void check_against_rival(const Report& report, const std::vector<NearPoint>& rival, const std::string& name) {
  std::vector<NearPoint> own;
  std::set<std::pair<int, int>> crossing;
  for (const Contact& contact : report.contacts()) {
    const std::pair bodies(static_cast<int>(contact.a.index), static_cast<int>(contact.b.index));
    if (!contact.facet_pairs().empty() || contact.containment != Containment::none) crossing.insert(bodies);
    for (const ContactPoint& point : contact.points()) {
      if (point.gap > 0.0)
        own.push_back({bodies.first, bodies.second, point.kind, point.a_vertices, point.b_vertices, point.gap});
    }
  }
  std::ranges::sort(own, {}, &NearPoint::key);
  const auto fail = [&](const NearPoint& point, const char* what) {
    throw std::runtime_error(fmt::format("points of {}: bodies {} and {}, kind {}, vertices {} and {}, gap {}: {}",
                                         name, point.body_a, point.body_b, static_cast<int>(point.kind), point.a[0],
                                         point.b[0], point.gap, what));
  };
  constexpr double kTie = 1e-12;  // metres
  std::size_t place = 0;
  for (const NearPoint& point : rival) {
    for (; place < own.size() && own[place].key() < point.key(); ++place) {
      if (own[place].gap > kTie) fail(own[place], "none of the rival's");
    }
    if (place < own.size() && own[place].key() == point.key()) {
      if (std::abs(own[place].gap - point.gap) > 1e-9) fail(point, "the gap is another one");
      ++place;
    } else if (point.gap > kTie && !crossing.contains({point.body_a, point.body_b})) {
      fail(point, "the rival's alone");
    }
  }
  for (; place < own.size(); ++place) {
    if (own[place].gap > kTie) fail(own[place], "none of the rival's");
  }
}

int run_points(const BenchOptions& options) {
  fmt::print(
      "{}\nmargins of {} % of a body's size, in recorded rows those of the scene; one thread, medians over the "
      "frames\n\n",
      machine_line(1), 100.0 * kMarginOfPoints);
  Table table({"workload", "points", "without ms", "with ms", "ratio", "and patches ms", "Embree's boxes ms",
               "CGAL's boxes ms", "factor", "and signs ms", "factor with signs"});
  tests::AnswerHash answers;
  for (const NamedWorkload& named : rival_workloads(options.quick ? Size::small : Size::full)) {
    if (!options.plays(named.name)) continue;
    fmt::print(stderr, "{}\n", named.name);
    const PointTimes m = measure(named.make(), named.name, options.quick, answers);
    table.add({named.name, fmt::format("{:.0f}", m.points), three_digits(m.without), three_digits(m.with),
               three_digits(m.with / m.without), three_digits(m.with_patches), three_digits(m.embree),
               three_digits(m.cgal), three_digits(m.fastest() / m.with), three_digits(m.signs),
               three_digits(m.signs / m.with)});
  }
  if (table.empty()) options.reject_only();
  table.print();
  print_answer_line(answers);
  if (!options.out.empty()) table.write_csv(options.out / "points.csv");
  return 0;
}

}  // namespace tact::bench

#include "scenes/dynamics/simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "scenes/dynamics/damping.h"
#include "scenes/dynamics/hull_push.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kLargeBody = 8192;        // vertices from which a body is worth all threads
constexpr std::size_t kVerticesAtATime = 2048;  // vertices

// The springs, volume and shape of a body, once each.
void hold_together(Body& body, double h, int threads) {
  body.springs.solve(body.positions, body.inverse_masses, h, threads);
  if (body.volume) body.volume->solve(body.positions, body.facets, body.inverse_masses, h);
  if (body.shape) body.shape->solve(body.positions, body.inverse_masses, h);
}

// Points deep inside do not agree on the way out: some point through thin parts to the far side. The contact direction,
// carried from step to step, leads all of them back to where the body came from.
void turn_deep_points(const Contact& contact, double size, BodyContact& points) {
  constexpr double kDeep = 0.05;  // shares of the smaller body's size
  if (points.deepest < kDeep * size) return;
  const Vec3 direction{contact.direction.x(), contact.direction.y(), contact.direction.z()};
  for (SurfacePoint& point : points.a_in_b) point.normal = -direction;
  for (SurfacePoint& point : points.b_in_a) point.normal = direction;
}

double longest_way(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double square = 0.0;
  for (std::size_t v = 0; v < from.size(); ++v) square = std::max(square, norm_squared(to[v] - from[v]));
  return std::sqrt(square);
}

}  // namespace

Simulation::Simulation(std::vector<Body> bodies, Script script, const DynamicsSettings& dynamics,
                       const Settings& settings, std::ostream* recording)
    : dynamics_(dynamics),
      script_(std::move(script)),
      threads_(settings.threads > 0 ? settings.threads : base::default_threads()),
      bodies_(std::move(bodies)),
      world_(settings),
      before_(bodies_.size()),
      seen_(bodies_.size()),
      last_seen_(bodies_.size()),
      moved_(bodies_.size(), 0.0),
      finders_(static_cast<std::size_t>(threads_)) {
  if (recording != nullptr) world_.set_observer(&recorder_.emplace(*recording));
  if (script_) script_(0.0, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    before_[i] = body.positions;
    show_surface(i);
    ids_.push_back(world_.add_body({.positions = as_matrix(seen_[i]),
                                    .facets = body.facets,
                                    .surface = body.surface,
                                    .motion = body.motion,
                                    .name = body.name,
                                    .margin = dynamics_.continuous ? dynamics_.margin : 0.0}));
    if (body.motion == Motion::fixed) continue;
    (body.positions.size() < kLargeBody ? small_ : large_).push_back(i);
  }
}

template <class Work>
void Simulation::for_each_body(const Work& work) {
  base::parallel_for(small_.size(), 4, threads_, [&](std::size_t i) { work(small_[i], 1); });
  for (const std::size_t i : large_) work(i, threads_);
}

void Simulation::step() {
  base::Timer timer;
  times_.begin = timer.start();
  if (report_ == nullptr && dynamics_.continuous) report_ = &world_.detect();
  move();
  times_.move_ms = timer.lap();
  if (dynamics_.continuous) stop_before_impacts();
  times_.impacts_ms = dynamics_.continuous ? timer.lap() : 0.0;
  show_surfaces();
  times_.surfaces_ms = timer.lap();
  const double written_ms = writing_ms();
  detect();
  times_.recording_ms = writing_ms() - written_ms;
  times_.engine_ms = timer.lap() - times_.recording_ms;
  if (!dynamics_.continuous) find_contacts();
  times_.contacts_ms = timer.lap();
  if (!dynamics_.continuous) settle();
  times_.settle_ms = timer.lap();
  measure();
}

void Simulation::move() {
  const double h = dynamics_.time_step / dynamics_.substeps;
  if (report_ != nullptr && !dynamics_.continuous) push_hulls_apart(report_->contacts(), bodies_, dynamics_.time_step);
  for (int substep = 1; substep <= dynamics_.substeps; ++substep) {
    for_each_body([&](std::size_t i, int threads) { begin_substep(i, h, threads); });
    if (script_) script_(state_.time + substep * h, bodies_);
    solver_.solve(bodies_, before_, threads_);
    for_each_body([&](std::size_t i, int threads) { end_substep(i, h, threads); });
  }
  for_each_body([&](std::size_t i, int /*threads*/) {
    if (bodies_[i].inner_damping > 0.0) damp_inner_motion(bodies_[i], dynamics_.time_step);
  });
  state_.time += dynamics_.time_step;
}

void Simulation::begin_substep(std::size_t i, double h, int threads) {
  Body& body = bodies_[i];
  std::vector<Vec3>& before = before_[i];
  const Vec3 fall{0.0, 0.0, -dynamics_.gravity * body.weight * h};
  const double keep = 1.0 / (1.0 + body.drag * h);
  base::parallel_for(body.positions.size(), kVerticesAtATime, threads, [&](std::size_t v) {
    before[v] = body.positions[v];
    if (!(body.inverse_masses[v] > 0.0)) return;
    body.positions[v] = body.positions[v] + (h * keep) * (body.velocities[v] + fall);
  });
  hold_together(body, h, threads);
}

void Simulation::end_substep(std::size_t i, double h, int threads) {
  Body& body = bodies_[i];
  const std::vector<Vec3>& before = before_[i];
  base::parallel_for(body.positions.size(), kVerticesAtATime, threads,
                     [&](std::size_t v) { body.velocities[v] = (1.0 / h) * (body.positions[v] - before[v]); });
}

// The last detection saw the bodies where the step began.
void Simulation::stop_before_impacts() { impacts_.run(seen_, dynamics_.time_step, ids_, bodies_, world_); }

void Simulation::show_surface(std::size_t i) {
  if (dynamics_.continuous) {
    seen_[i] = bodies_[i].positions;
  } else {
    move_out(bodies_[i], seen_[i]);
  }
}

void Simulation::show_surfaces() {
  for_each_body([&](std::size_t i, int /*threads*/) {
    std::swap(seen_[i], last_seen_[i]);
    show_surface(i);
    moved_[i] = longest_way(last_seen_[i], seen_[i]);
  });
}

void Simulation::detect() {
  std::vector<PositionsUpdate> updates;
  updates.reserve(small_.size() + large_.size());
  for (const std::vector<std::size_t>* group : {&small_, &large_}) {
    for (const std::size_t i : *group) {
      updates.push_back({ids_[i], as_matrix(seen_[i])});
    }
  }
  world_.set_positions(updates);
  report_ = &world_.detect();
}

void Simulation::find_contacts() {
  const auto contacts = report_->contacts();
  std::swap(contacts_, last_contacts_);
  contacts_.resize(contacts.size());
  base::parallel_for(contacts.size(), 16, threads_, [&](std::size_t i, int thread) {
    find_points(contacts[i], finders_[static_cast<std::size_t>(thread)], contacts_[i]);
  });
}

void Simulation::find_points(const Contact& contact, PenetrationFinder& finder, BodyContact& points) const {
  points.a = static_cast<int>(contact.a.index);
  points.b = static_cast<int>(contact.b.index);
  points.a_in_b.clear();
  points.b_in_a.clear();
  points.deepest = 0.0;
  if (!contact.touching()) return;
  const Body& a = bodies_[contact.a.index];
  const Body& b = bodies_[contact.b.index];
  const SeenBody seen_a{a, seen_[contact.a.index]};
  const SeenBody seen_b{b, seen_[contact.b.index]};
  finder.find(contact, true, seen_a, seen_b, points.a_in_b);
  finder.find(contact, false, seen_b, seen_a, points.b_in_a);
  const double most = deepest_possible(points);
  for (std::vector<SurfacePoint>* side : {&points.a_in_b, &points.b_in_a}) {
    for (SurfacePoint& point : *side) {
      point.depth = std::min(point.depth, most);
      points.deepest = std::max(points.deepest, point.depth);
    }
  }
  const bool solids = a.surface == Surface::closed && b.surface == Surface::closed;
  if (solids) turn_deep_points(contact, std::min(a.size, b.size), points);
}

// Where a surface is crumpled, points outside can pass for points inside. But no point goes deeper than the bodies were
// in each other plus the way that both went since.
double Simulation::deepest_possible(const BodyContact& contact) const {
  const auto last =
      std::lower_bound(last_contacts_.begin(), last_contacts_.end(), contact,
                       [](const BodyContact& i, const BodyContact& j) { return i.a != j.a ? i.a < j.a : i.b < j.b; });
  const bool known = last != last_contacts_.end() && last->a == contact.a && last->b == contact.b;
  return (known ? last->deepest : 0.0) + moved_[static_cast<std::size_t>(contact.a)] +
         moved_[static_cast<std::size_t>(contact.b)];
}

// The way out is shared with the springs, so that a body is moved rather than torn; neither changes a velocity, for a
// push out of a deep contact would throw the body.
void Simulation::settle() {
  // More overshoots where many contacts share a body, and tears where they disagree on the way.
  constexpr WayOut kPart{.share = 0.7, .most = 0.05};
  const double h = dynamics_.time_step / dynamics_.substeps;
  solver_.start(contacts_, bodies_, dynamics_.slop);
  for (int sweep = 0; sweep < dynamics_.settle_sweeps; ++sweep) {
    solver_.push_out(bodies_, kPart, threads_);
    for_each_body([&](std::size_t i, int threads) { hold_together(bodies_[i], h, threads); });
  }
  solver_.push_out(bodies_, kPart, threads_);
  solver_.hold(bodies_);
}

void Simulation::measure() {
  state_.kinetic_energy = 0.0;
  for (const Body& body : bodies_) {
    if (body.dynamic) state_.kinetic_energy += kinetic_energy(body);
  }
  state_.contact_points = 0;
  state_.deepest = 0.0;
  for (const BodyContact& contact : contacts_) {
    const Body& a = bodies_[static_cast<std::size_t>(contact.a)];
    const Body& b = bodies_[static_cast<std::size_t>(contact.b)];
    state_.contact_points += static_cast<std::int64_t>(contact.a_in_b.size() + contact.b_in_a.size());
    state_.deepest = std::max(state_.deepest, (contact.deepest - a.skin - b.skin) / std::min(a.size, b.size));
  }
}

}  // namespace tact::scenes

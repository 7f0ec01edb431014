#include "scenes/dynamics/simulation.h"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "scenes/dynamics/damping.h"
#include "scenes/dynamics/free_way.h"
#include "scenes/dynamics/stats_sum.h"
#include "scenes/dynamics/substep.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kLargeBody = 8192;  // vertices from which a body is worth all threads

Settings with_points(Settings settings) {
  settings.outputs.points = true;
  return settings;
}

}  // namespace

Simulation::Simulation(std::vector<Body> bodies, Script script, const DynamicsSettings& dynamics,
                       const Settings& settings, std::ostream* recording)
    : dynamics_(dynamics),
      script_(std::move(script)),
      threads_(settings.threads > 0 ? settings.threads : base::default_threads()),
      bodies_(std::move(bodies)),
      world_(with_points(settings)),
      before_(bodies_.size()),
      reach_(bodies_.size(), 0.0),
      last_way_(bodies_.size(), 0.0),
      way_(bodies_.size(), 0.0) {
  if (recording != nullptr) world_.set_observer(&recorder_.emplace(*recording));
  if (script_) script_(0.0, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (stops_impacts()) body.rigid.reset();
    before_[i] = body.positions;
    reach_[i] = body.motion == Motion::fixed ? 0.0 : dynamics_.least_reach;
    ids_.push_back(add_to_world(body, dynamics_.continuous ? dynamics_.margin : body.thickness + reach_[i]));
    if (body.motion == Motion::fixed) continue;
    (body.positions.size() < kLargeBody ? small_ : large_).push_back(i);
  }
}

BodyId Simulation::add_to_world(const Body& body, double margin) {
  if (body.plane)
    return world_.add_plane(
        {.normal = body.plane->normal, .offset = body.plane->offset, .name = body.name, .margin = margin});
  return world_.add_body({.positions = as_matrix(body.positions),
                          .facets = body.facets,
                          .edges = body.edges,
                          .points = body.grains,
                          .surface = body.surface,
                          .motion = body.motion,
                          .name = body.name,
                          .margin = margin,
                          .self_contact = body.self_contact});
}

template <class Work>
void Simulation::for_each_body(const Work& work) {
  base::parallel_for(small_.size(), 4, threads_, [&](std::size_t i) {
    if (!bodies_[small_[i]].asleep) work(small_[i], 1);
  });
  for (const std::size_t i : large_) {
    if (!bodies_[i].asleep) work(i, threads_);
  }
}

void Simulation::step() {
  times_ = {.stretches = std::move(times_.stretches)};
  times_.stretches.clear();
  const double h = dynamics_.time_step / dynamics_.substeps;
  stats_ = {};
  state_ = {.time = state_.time, .kinetic_energy = state_.kinetic_energy};
  if (report_ == nullptr) detect();
  for (int substep = 1; substep <= dynamics_.substeps; ++substep) {
    run_substep(h);
    if (substep < dynamics_.substeps && !dynamics_.continuous && has_left_its_reach(h)) detect();
  }
  detect();
  rest();
}

// What moves within bodies is damped, and those that are still fall asleep.
void Simulation::rest() {
  base::Timer timer;
  for_each_body([&](std::size_t i, int /*threads*/) {
    if (bodies_[i].inner_damping > 0.0 && !bodies_[i].rigid) damp_inner_motion(bodies_[i], dynamics_.time_step);
  });
  sleep_.update(*report_, dynamics_.time_step, dynamics_.sleep, bodies_);
  state_.kinetic_energy = 0.0;
  for (const Body& body : bodies_) {
    if (!body.dynamic) continue;
    state_.kinetic_energy += kinetic_energy(body);
    ++(body.asleep ? state_.asleep : state_.awake);
  }
  times_.sleep_ms += note("sleep", timer);
}

void Simulation::run_substep(double h) {
  base::Timer timer;
  for_each_body([&](std::size_t i, int threads) {
    begin_substep(bodies_[i], before_[i], {.seconds = h, .gravity = dynamics_.gravity, .threads = threads});
  });
  state_.time += h;
  if (script_) script_(state_.time, bodies_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) follow_facets(i);
  times_.move_ms += note("motion", timer);
  if (!dynamics_.continuous) {
    solver_.push(bodies_, before_, dynamics_.contact, h, threads_);
    if (dynamics_.stay_within_reach) {
      for_each_body([&](std::size_t i, int /*threads*/) {
        shorten_ways(bodies_[i], before_[i], std::max(free_[i] - way_[i], 0.0));
      });
    }
    solver_.retreat(bodies_, before_, dynamics_.contact, threads_);
  }
  times_.contacts_ms += note("contact points", timer);
  for_each_body([&](std::size_t i, int threads) {
    last_way_[i] =
        end_substep(bodies_[i], before_[i], {.seconds = h, .gravity = dynamics_.gravity, .threads = threads});
    way_[i] += last_way_[i];
  });
  times_.move_ms += note("motion", timer);
}

// New vertices come from where those were that they were; the contact points of the last detection name these by their
// old numbers, so that it is time for the next one.
void Simulation::follow_facets(std::size_t i) {
  Body& body = bodies_[i];
  if (body.vertex_map.empty()) return;
  const auto follow = [&](std::vector<Vec3>& positions) {
    std::vector<Vec3> now = body.positions;
    for (std::size_t v = 0; v < now.size(); ++v) {
      if (const int was = body.vertex_map[v]; was >= 0) now[v] = positions[static_cast<std::size_t>(was)];
    }
    positions = std::move(now);
  };
  follow(before_[i]);
  if (!detected_.empty()) follow(detected_[i]);
  world_.set_facets(ids_[i], {.positions = as_matrix(body.positions),
                              .facets = body.facets,
                              .edges = body.edges,
                              .points = body.grains,
                              .vertex_map = body.vertex_map});
  body.vertex_map.clear();
  facets_changed_ = true;
}

double Simulation::note(const char* name, base::Timer& timer) {
  const auto begin = timer.start();
  const double ms = timer.lap();
  times_.stretches.push_back({name, begin, timer.start()});
  return ms;
}

// Two bodies that were farther apart than both margins stay apart by their thicknesses while neither leaves its reach.
bool Simulation::has_left_its_reach(double h) const {
  if (facets_changed_) return true;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].asleep || bodies_[i].motion == Motion::fixed) continue;
    if (way_[i] + last_way_[i] + dynamics_.gravity * h * h > free_[i]) return true;
  }
  return false;
}

void Simulation::set_reach(std::size_t i) {
  const double reach = next_reach(reach_[i], last_way_[i], dynamics_);
  if (reach == reach_[i]) return;
  reach_[i] = reach;
  world_.set_margin(ids_[i], bodies_[i].thickness + reach);
}

// Since the last detection, if anything moved.
void Simulation::stop_before_impacts() {
  if (std::ranges::none_of(way_, [](double way) { return way > 0.0; })) return;
  base::Timer timer;
  const bool guards = !dynamics_.continuous;  // and margins are those of contact points
  if (guards) {
    for (const BodyId id : ids_) world_.set_margin(id, dynamics_.margin);
  }
  const auto last_resort = guards ? ImpactResponse::LastResort::some_stay : ImpactResponse::LastResort::all_stop;
  impacts_.run(detected_, state_.time - detected_time_, last_resort, ids_, bodies_, world_);
  if (guards) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) world_.set_margin(ids_[i], bodies_[i].thickness + reach_[i]);
  }
  state_.impacts += impacts_.impacts();
  state_.stayed += impacts_.stayed();
  times_.impacts_ms += note("impacts", timer);
}

void Simulation::detect() {
  if (stops_impacts() && report_ != nullptr) stop_before_impacts();
  base::Timer timer;
  const double written_ms = writing_ms();
  std::vector<PositionsUpdate> updates;
  for_each_body([&](std::size_t i, int /*threads*/) {
    if (bodies_[i].rigid && way_[i] > 0.0) bodies_[i].rigid->place(bodies_[i].positions);
  });
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!(way_[i] > 0.0)) continue;
    updates.push_back({ids_[i], as_matrix(bodies_[i].positions)});
    way_[i] = 0.0;
    if (!dynamics_.continuous) set_reach(i);
  }
  world_.set_positions(updates);
  report_ = &world_.detect();
  facets_changed_ = false;
  const double recording_ms = writing_ms() - written_ms;
  times_.recording_ms += recording_ms;
  times_.engine_ms += note("engine", timer) - recording_ms;
  ++state_.detections;
  add_to(stats_, report_->stats());
  if (!dynamics_.continuous) solver_.take(*report_, bodies_, threads_);
  if (stops_impacts()) {
    detected_.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) detected_[i] = bodies_[i].positions;
    detected_time_ = state_.time;
  }
  limit_ways();
  measure_contacts();
  times_.contacts_ms += note("contact points", timer);
}

void Simulation::limit_ways() {
  free_ = reach_;
  if (stops_impacts()) return;
  const auto moves = [](const Body& body) { return body.motion != Motion::fixed && !body.asleep; };
  for (const Contact& contact : report_->contacts()) {
    const std::size_t a = contact.a.index, b = contact.b.index;
    const Movers movers = moves(bodies_[a]) && moves(bodies_[b]) ? Movers::both : Movers::one;
    const double free = free_way(smallest_gap(contact.points()), bodies_[a].thickness + bodies_[b].thickness, movers);
    free_[a] = std::min(free_[a], free);
    free_[b] = std::min(free_[b], free);
  }
}

void Simulation::measure_contacts() {
  state_.contact_points = 0;
  for (const Contact& contact : report_->contacts()) {
    const Body &a = bodies_[contact.a.index], &b = bodies_[contact.b.index];
    (contact.a == contact.b ? state_.self_facet_pairs : state_.facet_pairs) +=
        static_cast<std::int64_t>(contact.facet_pairs().size());
    state_.contact_points += static_cast<std::int64_t>(contact.points().size());
    const double wanted = dynamics_.continuous ? 2.0 * dynamics_.margin : a.thickness + b.thickness;
    const double size = std::min(a.size, b.size);
    const double gap = smallest_gap(contact.points());
    state_.smallest_gap = std::min(state_.smallest_gap, gap);
    state_.squeezed = std::max(state_.squeezed, (wanted - gap) / size);
    state_.crossed = std::max(state_.crossed, -gap / size);
  }
}

}  // namespace tact::scenes

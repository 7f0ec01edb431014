#include "mpi/program/pile_simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "mpi/bytes.h"
#include "scenes/dynamics/damping.h"
#include "scenes/dynamics/free_way.h"
#include "scenes/dynamics/substep.h"

namespace tact::mpi::program {
namespace {

// As in the scene: so low that no body falls faster than contacts follow.
constexpr double kMostLayers = 5.0;
constexpr std::size_t kBodiesAtATime = 4;

Settings with_points(Settings settings) {
  settings.world.outputs.points = true;
  return settings;
}

// All contacts at once get on more slowly than one after the other: twice as many sweeps, in which no point may miss
// anything.
scenes::DynamicsSettings dynamics_of_pile() {
  scenes::DynamicsSettings dynamics = scenes::pile_dynamics();
  dynamics.contact.most_sweeps *= 2;
  dynamics.contact.spare = 0.0;
  return dynamics;
}

std::int64_t sum_over_ranks(std::int64_t value, MPI_Comm communicator) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, communicator);
  return value;
}

void add(const Statistics& detection, Statistics& sum) {
  const Statistics before = sum;
  sum = detection;
  for (const auto member : {&Statistics::messages, &Statistics::bytes, &Statistics::box_bytes, &Statistics::shape_bytes,
                            &Statistics::positions_bytes, &Statistics::result_bytes, &Statistics::moved_bodies,
                            &Statistics::moved_bytes, &Statistics::pairs, &Statistics::work})
    sum.*member += before.*member;
}

}  // namespace

PileSimulation::PileSimulation(MPI_Comm communicator, const PileOptions& options)
    : communicator_(communicator),
      size_(options.size),
      grid_(scenes::pile_grid(options.size, kMostLayers)),
      dynamics_(dynamics_of_pile()),
      world_(communicator, with_points(options.settings)),
      threads_(options.settings.world.threads > 0 ? options.settings.world.threads : base::default_threads()),
      contacts_(communicator, threads_) {
  world_.set_body_state({.pack = [this](std::uint64_t key) { return pack(key); },
                         .unpack = [this](std::uint64_t key, auto bytes) { unpack(key, bytes); },
                         .drop =
                             [this](std::uint64_t key) {
                               if (arrived_.erase(key) == 0) gone_.push_back(key);
                             }});
  const auto add = [&](const Body& body, std::uint64_t key, double reach, Holders holders) {
    world_.add_body({.positions = scenes::as_matrix(body.positions),
                     .facets = body.facets,
                     .surface = body.surface,
                     .motion = body.motion,
                     .name = body.name,
                     .key = key,
                     .margin = body.thickness + reach},
                    holders);
  };
  const std::int64_t all = size_;
  const std::int64_t begin = all * world_.rank() / world_.rank_count(),
                     end = all * (world_.rank() + 1) / world_.rank_count();
  for (std::int64_t i = begin; i < end; ++i) {
    const auto key = static_cast<std::uint64_t>(i);
    keys_.push_back(key);
    bodies_.push_back(make_body(key));
    progress_.push_back({.reach = dynamics_.least_reach});
    add(bodies_.back(), key, dynamics_.least_reach, Holders::this_rank);
  }
  auto key = static_cast<std::uint64_t>(size_);
  for (Body& wall : scenes::pile_bin(grid_)) {
    add(wall, key++, 0.0, Holders::every_rank);
    bodies_.push_back(std::move(wall));
  }
  for (const Body& body : bodies_) before_.push_back(body.positions);
  if (world_.rank_count() > 1) {
    world_.rebalance();
    move_in_and_out();
  }
}

// A body's rest shape follows from its key, so that a rank that gets it makes it by itself.
Body PileSimulation::make_body(std::uint64_t key) const {
  scenes::Random random(key);
  const int number = static_cast<int>(key);
  return scenes::pile_body(number, number, grid_, scenes::PileBody::soft, random);
}

std::size_t PileSimulation::index_of(std::uint64_t key) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(keys_, key) - keys_.begin());
}

std::vector<std::byte> PileSimulation::pack(std::uint64_t key) const {
  const std::size_t i = index_of(key);
  const Body& body = bodies_[i];
  ByteWriter writer;
  writer.put(body.asleep);
  writer.put_all(std::span(&progress_[i], 1));
  writer.put_all(std::span(&body.shape->rotation(), 1));
  writer.put_all(body.positions);
  writer.put_all(body.velocities);
  return std::move(writer.bytes());
}

void PileSimulation::unpack(std::uint64_t key, std::span<const std::byte> bytes) {
  Arrived arrived{.body = make_body(key), .progress = {}};
  ByteReader reader(bytes);
  arrived.body.asleep = reader.get<bool>();
  arrived.progress = reader.get_all<Progress>().at(0);
  arrived.body.shape->set_rotation(reader.get_all<scenes::Quaternion>().at(0));
  arrived.body.positions = reader.get_all<Vec3>();
  arrived.body.velocities = reader.get_all<Vec3>();
  arrived_.insert_or_assign(key, std::move(arrived));
}

void PileSimulation::move_in_and_out() {
  if (arrived_.empty() && gone_.empty()) return;
  std::ranges::sort(gone_);
  std::vector<std::uint64_t> keys;
  std::vector<Body> bodies;
  std::vector<Progress> progress;
  const auto keep = [&](std::uint64_t key, Body&& body, const Progress& of_body) {
    keys.push_back(key);
    bodies.push_back(std::move(body));
    progress.push_back(of_body);
  };
  auto next = arrived_.begin();
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (std::ranges::binary_search(gone_, keys_[i])) continue;
    for (; next != arrived_.end() && next->first < keys_[i]; ++next)
      keep(next->first, std::move(next->second.body), next->second.progress);
    keep(keys_[i], std::move(bodies_[i]), progress_[i]);
  }
  for (; next != arrived_.end(); ++next) keep(next->first, std::move(next->second.body), next->second.progress);
  std::move(bodies_.begin() + static_cast<std::ptrdiff_t>(keys_.size()), bodies_.end(), std::back_inserter(bodies));
  keys_ = std::move(keys);
  bodies_ = std::move(bodies);
  progress_ = std::move(progress);
  before_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) before_[i] = bodies_[i].positions;
  arrived_.clear();
  gone_.clear();
}

template <class Work>
void PileSimulation::for_each_body(const Work& work) {
  base::parallel_for(keys_.size(), kBodiesAtATime, threads_, [&](std::size_t i) {
    if (!bodies_[i].asleep) work(i);
  });
}

void PileSimulation::step() {
  const double h = dynamics_.time_step / dynamics_.substeps;
  stats_ = {};
  state_ = {.time = state_.time};
  if (report_ == nullptr) detect();
  for (int substep = 1; substep <= dynamics_.substeps; ++substep) {
    run_substep(h);
    if (substep == dynamics_.substeps) break;
    int left = has_left_its_reach(h) ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &left, 1, MPI_INT, MPI_MAX, communicator_);
    if (left != 0) detect();
  }
  detect();
  rest();
  measure();
}

void PileSimulation::run_substep(double h) {
  const scenes::Substep substep{.seconds = h, .gravity = dynamics_.gravity};
  for_each_body([&](std::size_t i) { begin_substep(bodies_[i], before_[i], substep); });
  contacts_.push(bodies_, before_, dynamics_.contact, h);
  for_each_body([&](std::size_t i) {
    shorten_ways(bodies_[i], before_[i], std::max(progress_[i].free - progress_[i].way, 0.0));
  });
  contacts_.retreat(bodies_, before_, dynamics_.contact);
  for_each_body([&](std::size_t i) {
    progress_[i].last_way = end_substep(bodies_[i], before_[i], substep);
    progress_[i].way += progress_[i].last_way;
  });
  state_.time += h;
}

bool PileSimulation::has_left_its_reach(double h) const {
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const Progress& p = progress_[i];
    if (!bodies_[i].asleep && p.way + p.last_way + dynamics_.gravity * h * h > p.free) return true;
  }
  return false;
}

void PileSimulation::detect() {
  std::vector<PositionsUpdate> updates;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    Progress& p = progress_[i];
    if (!(p.way > 0.0)) continue;
    updates.push_back({keys_[i], scenes::as_matrix(bodies_[i].positions)});
    p.way = 0.0;
    const double reach = scenes::next_reach(p.reach, p.last_way, dynamics_);
    if (reach == p.reach) continue;
    p.reach = reach;
    world_.set_margin(keys_[i], bodies_[i].thickness + reach);
  }
  world_.set_positions(updates);
  report_ = &world_.detect();
  move_in_and_out();  // where the world rebalanced
  add(report_->stats(), stats_);
  ++state_.detections;
  take_contacts();
  limit_ways();
}

int PileSimulation::place_of(std::uint64_t key) const {
  if (key >= static_cast<std::uint64_t>(size_))
    return static_cast<int>(keys_.size() + (key - static_cast<std::uint64_t>(size_)));
  const std::size_t i = index_of(key);
  return i < keys_.size() && keys_[i] == key ? static_cast<int>(i) : SharedContact::kElsewhere;
}

void PileSimulation::take_contacts() {
  std::vector<SharedContact> shared;
  shared.reserve(report_->contacts().size());
  for (const auto& [bodies, contact] : report_->contacts()) {
    SharedContact& taken = shared.emplace_back();
    taken.body = {place_of(bodies.key_a), place_of(bodies.key_b)};
    if (taken.body[0] == SharedContact::kElsewhere) taken.rank = bodies.rank_a;
    if (taken.body[1] == SharedContact::kElsewhere) taken.rank = bodies.rank_b;
    taken.points = contact.points();
  }
  contacts_.take(std::move(shared), bodies_);
}

void PileSimulation::limit_ways() {
  for (Progress& p : progress_) p.free = p.reach;
  const auto contacts = report_->contacts();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Partner &a = contacts_.partner(c, 0), &b = contacts_.partner(c, 1);
    const auto movers = a.moves && b.moves ? scenes::Movers::both : scenes::Movers::one;
    const double gap = scenes::smallest_gap(contacts[c].contact.points());
    const double free = scenes::free_way(gap, a.thickness + b.thickness, movers);
    for (const int body : contacts_.contacts()[c].body) {
      if (body == SharedContact::kElsewhere || static_cast<std::size_t>(body) >= keys_.size()) continue;
      progress_[body].free = std::min(progress_[body].free, free);
    }
  }
}

// What moves within bodies is damped, and those that are still fall asleep.
void PileSimulation::rest() {
  for_each_body([&](std::size_t i) { damp_inner_motion(bodies_[i], dynamics_.time_step); });
  contacts_.share_partners(bodies_);
  std::vector<char> disturbed(keys_.size(), 0);
  const auto contacts = report_->contacts();
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double thickness = contacts_.partner(c, 0).thickness + contacts_.partner(c, 1).thickness;
    for (int side = 0; side < 2; ++side) {
      const int body = contacts_.contacts()[c].body[side];
      const Partner& other = contacts_.partner(c, 1 - side);
      if (body == SharedContact::kElsewhere || static_cast<std::size_t>(body) >= keys_.size()) continue;
      if (!scenes::disturbs(other.square_speed, other.dynamic, dynamics_.sleep)) continue;
      if (!other.dynamic || scenes::presses(contacts[c].contact, thickness)) disturbed[body] = 1;
    }
  }
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    scenes::settle(bodies_[i], progress_[i].rest, scenes::mean_square_speed(bodies_[i]), disturbed[i] != 0,
                   dynamics_.time_step, dynamics_.sleep);
  }
}

void PileSimulation::measure() {
  constexpr double kEnergyUnit = 0x1p-30;  // joules
  std::int64_t energy = 0;
  for (const Body& body : bodies()) {
    energy += std::llround(kinetic_energy(body) / kEnergyUnit);
    ++(body.asleep ? state_.asleep : state_.awake);
  }
  for (const auto& [bodies, contact] : report_->contacts()) {
    if (!bodies.counted) continue;
    ++state_.contacts;
    state_.contact_points += static_cast<std::int64_t>(contact.points().size());
    state_.facet_pairs += static_cast<std::int64_t>(contact.facet_pairs().size());
    state_.smallest_gap = std::min(state_.smallest_gap, scenes::smallest_gap(contact.points()));
  }
  state_.kinetic_energy = kEnergyUnit * static_cast<double>(sum_over_ranks(energy, communicator_));
  for (std::int64_t* const count :
       {&state_.awake, &state_.asleep, &state_.contacts, &state_.contact_points, &state_.facet_pairs})
    *count = sum_over_ranks(*count, communicator_);
  MPI_Allreduce(MPI_IN_PLACE, &state_.smallest_gap, 1, MPI_DOUBLE, MPI_MIN, communicator_);
}

}  // namespace tact::mpi::program

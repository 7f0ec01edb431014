#include <tact/mpi/world.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "engine/base/hash.h"
#include "mpi/mesh_bytes.h"
#include "mpi/world_implementation.h"

namespace tact::mpi {

namespace {

[[noreturn]] void refuse(ErrorCode code, const std::string& what) { throw Error(code, what); }

std::string key_text(std::uint64_t key) { return "key " + std::to_string(key); }

void check(const Settings& settings) {
  if (!(settings.rebalance_above == 0.0 || settings.rebalance_above >= 1.0))
    refuse(ErrorCode::bad_settings,
           "rebalance_above is " + std::to_string(settings.rebalance_above) + ", not 0 or at least 1");
  if (settings.partitioner != Partitioner::rcb && settings.partitioner != Partitioner::hsfc)
    refuse(ErrorCode::bad_settings, "the partitioner has no name");
}

std::uint64_t hash_of(const Settings& settings) {
  base::Hash hash;
  hash.add(WorldParts::checksum(WorldParts::settings_bytes(settings.world)));
  hash.add(settings.rebalance_above);
  hash.add(static_cast<std::uint64_t>(settings.partitioner));
  return hash.value();
}

// Settings that are good, and the same on all ranks.
Settings agreed(const Settings& settings, Channel& channel) {
  channel.together([&] {
    check(settings);
    tact::World trial(settings.world);  // throws if they are bad
  });
  const auto hashes = channel.gather(hash_of(settings));
  if (std::ranges::any_of(hashes, [&](std::uint64_t hash) { return hash != hashes.front(); }))
    refuse(ErrorCode::bad_settings, "the ranks have different settings");
  return settings;
}

template <class Definition>
void add_place(const Definition& definition, base::Hash& hash) {
  hash.add(definition.margin);
  hash.add(definition.rest_offset.value_or(-1.0));
  for (const std::uint32_t number : {definition.layer, definition.mask, definition.group})
    hash.add(std::uint64_t{number});
}

// Of a body that every rank adds: what all of them must agree on.
std::uint64_t hash_of(const BodyDefinition& definition) {
  base::Hash hash;
  hash.add(*definition.key);
  for (std::ptrdiff_t i = 0; i < definition.positions.cols(); ++i) {
    for (const double coordinate : definition.positions.column(i)) hash.add(coordinate);
  }
  const auto add_all = [&](const auto& columns) {
    for (std::ptrdiff_t i = 0; i < columns.cols(); ++i) {
      for (const int vertex : columns.column(i)) hash.add(static_cast<std::uint64_t>(vertex));
    }
    hash.add(static_cast<std::uint64_t>(columns.cols()));
  };
  add_all(definition.facets), add_all(definition.edges);
  for (const int vertex : definition.points) hash.add(static_cast<std::uint64_t>(vertex));
  hash.add(static_cast<std::uint64_t>(definition.surface));
  hash.add(std::uint64_t{definition.self_contact});
  add_place(definition, hash);
  return hash.value();
}

std::uint64_t hash_of(const PlaneDefinition& definition) {
  base::Hash hash;
  hash.add(*definition.key);
  for (const double number : {definition.normal.x(), definition.normal.y(), definition.normal.z(), definition.offset})
    hash.add(number);
  add_place(definition, hash);
  return hash.value();
}

[[noreturn]] void refuse_without_key() {
  refuse(ErrorCode::invalid_argument, "a body over many ranks is named by its key: it has none");
}

}  // namespace

World::Implementation::Implementation(MPI_Comm communicator, const Settings& given)
    : channel(communicator), settings(agreed(given, channel)), local(given.world), directory(channel) {
  partition = std::make_unique<Partition>(channel, settings.partitioner);
  parts.set_choice(&held);
}

OwnBody& World::Implementation::at(std::uint64_t key) {
  const auto found = held.own.find(key);
  if (found == held.own.end())
    refuse(ErrorCode::stale_body, "rank " + std::to_string(channel.rank()) + " owns no body of " + key_text(key));
  return found->second;
}

// What did not change is not sent.
void World::Implementation::note_change(OwnBody& body, bool has_moved) {
  if (!parts.moved(body.id)) return;
  ++body.version;
  if (has_moved) body.positions = body.version;
}

// By the owner of the first body of the pair; that of the other may have to be told.
void World::Implementation::set_excluded(const ExcludedPair& pair, bool wanted) {
  if (held.excluded.contains(pair) == wanted) return;
  exclude(pair, wanted, true);
  if (held.own.contains(pair.other)) return exclude(pair.swapped(), wanted, true);
  exclusions.push_back({pair, wanted, true});
}

void World::Implementation::exclude(const ExcludedPair& pair, bool wanted, bool marks) {
  OwnBody& body = at(pair.key);
  if (held.excluded.contains(pair) == wanted) return;
  held.set_excluded(pair, wanted);
  exclude_here(pair, wanted);
  if (!marks) return;
  parts.mark_moved(body.id, false);
  note_change(body, false);
}

// Of an own body and another, if that is here.
void World::Implementation::exclude_here(const ExcludedPair& pair, bool wanted) {
  const BodyId own = at(pair.key).id, other = held.find(pair.other);
  if (!local.contains(other)) return;
  if (pair.is_of_labels())
    parts.exclude({own, pair.label, other, pair.label_of_other, pair.kind}, wanted);
  else
    parts.exclude(own, other, wanted);
}

// A body comes of the key of a ghost: its owner has removed that one, or the next call together refuses the key. A body
// that is refused leaves the ghost; if add() fails otherwise the owner may have it still, and sends it anew.
template <class Definition, class Add>
BodyId World::Implementation::add_in_place_of_ghost(const Definition& definition, const Add& add) {
  const std::uint64_t key = *definition.key;
  if (held.ghosts.contains(key)) parts.check(definition);
  const bool was_ghost = forget_ghost(key);
  try {
    return add();
  } catch (...) {
    lost_ghost = lost_ghost || was_ghost;
    throw;
  }
}

bool World::Implementation::forget_ghost(std::uint64_t key) {
  held.shapes.erase(key);
  const auto ghost = held.ghosts.find(key);
  if (ghost == held.ghosts.end()) return false;
  const auto [id, owner] = ghost->second;
  held.gone[id] = {key, owner, true};
  parts.remove_copy(id);
  held.drop(id);
  held.ghosts.erase(ghost);
  return true;
}

HostOrder World::Implementation::order_of_new(BodyId id, std::uint64_t key) const {
  return {static_cast<std::int64_t>(local.vertex_count(id)), key};
}

// Its slot may be another on each rank: what is kept of a pair with it must not go by that.
void World::Implementation::hold_shared(BodyId id, std::uint64_t key, std::uint64_t hash) {
  parts.set_birth(id, hash);
  held.hold(id, {Held::Role::shared, channel.rank(), order_of_new(id, key)});
  held.shared[key] = id;
  new_shared.insert(key);
}

// The same on all ranks if they hold the same, and removed the same since they last agreed.
std::uint64_t World::Implementation::hash_of_shared() const {
  std::uint64_t hash = removed_shared;
  for (const auto& [key, id] : held.shared) hash += parts.birth(id);
  return hash;
}

World::World(MPI_Comm communicator, const Settings& settings)
    : implementation_(std::make_unique<Implementation>(communicator, settings)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

World::Implementation& World::implementation() const {
  if (implementation_ == nullptr) refuse(ErrorCode::wrong_order, "the world was moved to another");
  return *implementation_;
}

int World::rank() const { return implementation().channel.rank(); }
int World::rank_count() const { return implementation().channel.size(); }
const Settings& World::settings() const { return implementation().settings; }

void World::set_settings(const Settings& settings) {
  Implementation& i = implementation();
  std::unique_ptr<Partition> partition;
  agreed(settings, i.channel);
  i.channel.together([&] {
    if (settings.partitioner != i.settings.partitioner)
      partition = std::make_unique<Partition>(i.channel, settings.partitioner);
  });
  i.local.set_settings(settings.world);
  i.settings = settings;
  i.sends_all = true;
  if (partition == nullptr) return;
  i.partition = std::move(partition);
  i.needs_near = true;
}

void World::add_body(const BodyDefinition& definition, Holders holders) {
  Implementation& i = implementation();
  if (!definition.key) refuse_without_key();
  const std::uint64_t key = *definition.key;
  const bool is_shared = holders == Holders::every_rank;
  if (is_shared && definition.motion != Motion::fixed)
    refuse(ErrorCode::invalid_argument, key_text(key) + ": what every rank holds is fixed");
  const BodyId id = i.add_in_place_of_ghost(definition, [&] { return i.local.add_body(definition); });
  if (is_shared) return i.hold_shared(id, key, hash_of(definition));
  i.held.hold(id, {Held::Role::own, i.channel.rank(), i.order_of_new(id, key)});
  i.held.own[key] = {.id = id, .is_rigid = definition.motion == Motion::rigid};
  i.new_keys.push_back(key);
}

void World::add_plane(const PlaneDefinition& definition) {
  Implementation& i = implementation();
  if (!definition.key) refuse_without_key();
  const BodyId id = i.add_in_place_of_ghost(definition, [&] { return i.local.add_plane(definition); });
  i.hold_shared(id, *definition.key, hash_of(definition));
}

void World::remove_body(std::uint64_t key) {
  Implementation& i = implementation();
  if (const auto shared = i.held.shared.find(key); shared != i.held.shared.end()) {
    const BodyId id = shared->second;
    i.local.remove_body(id);
    for (const ExcludedPair& pair : HeldBodies::pairs_of(i.held.excluders, key))
      i.held.set_excluded(pair.swapped(), false);
    std::erase_if(i.exclusions, [&](const auto& one) { return one.pair.other == key; });
    i.held.gone[id] = {key, -1, true};
    i.held.drop(id);
    i.held.shared.erase(shared);
    if (i.new_shared.erase(key) == 0) i.removed_shared += base::mixed(key);
    return;
  }
  OwnBody& body = i.at(key);
  for (Implementation::Exclusion& one : i.exclusions) {
    if (one.pair.key == key) one.wanted = one.marks = false;  // another body may come with the key
  }
  for (const ExcludedPair& pair : HeldBodies::pairs_of(i.held.excluded, key)) {
    if (i.held.own.contains(pair.other))
      i.exclude(pair.swapped(), false, false);
    else if (!i.held.shared.contains(pair.other))
      i.exclusions.push_back({pair, false, false});
    i.held.set_excluded(pair, false);
  }
  i.local.remove_body(body.id);
  i.held.gone[body.id] = {key, -1, true};
  i.held.drop(body.id);
  for (WaitingPair& pair : i.waiting) {
    if (pair.pair.key_a != key && pair.pair.key_b != key) continue;
    pair.pair.bytes.clear();
    (pair.pair.key_a == key ? pair.pair.birth_a : pair.pair.birth_b) = 0;
  }
  if (!body.subscribers.empty()) i.removed[key] = std::move(body.subscribers);
  if (std::erase(i.new_keys, key) == 0) i.gone_keys.push_back(key);
  i.new_owners.erase(key);
  i.held.own.erase(key);
}

void World::set_positions(std::uint64_t key, const Positions& positions) {
  Implementation& i = implementation();
  OwnBody& body = i.at(key);
  i.local.set_positions(body.id, positions);
  i.note_change(body, true);
}

void World::set_positions(std::span<const PositionsUpdate> updates) {
  Implementation& i = implementation();
  std::vector<tact::PositionsUpdate> by_id;
  for (const PositionsUpdate& update : updates) by_id.push_back({i.at(update.key).id, update.positions});
  i.local.set_positions(by_id);
  for (const PositionsUpdate& update : updates) i.note_change(i.at(update.key), true);
}

void World::set_facets(std::uint64_t key, const MeshUpdate& update) {
  Implementation& i = implementation();
  OwnBody& body = i.at(key);
  // What is kept of pairs that wait for their guests goes by the vertices of before.
  if (i.owners_changed)
    refuse(ErrorCode::wrong_order, key_text(key) + ": bodies have other owners: facets change after the next detect()");
  Bytes bytes = bytes_of(update);
  body.meshes.reserve(body.meshes.size() + 1);  // from then on nothing but the change itself can fail
  i.local.set_facets(body.id, update);
  body.meshes.push_back(std::move(bytes));
  i.note_change(body, false);
  body.shape = body.version;
}

void World::set_pose(std::uint64_t key, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  Implementation& i = implementation();
  OwnBody& body = i.at(key);
  i.local.set_pose(body.id, rotation, translation);
  i.note_change(body, true);
}

void World::set_poses(std::span<const PoseUpdate> updates) {
  Implementation& i = implementation();
  std::vector<tact::PoseUpdate> by_id;
  for (const PoseUpdate& update : updates) by_id.push_back({i.at(update.key).id, update.rotation, update.translation});
  i.local.set_poses(by_id);
  for (const PoseUpdate& update : updates) i.note_change(i.at(update.key), true);
}

void World::set_layers(std::uint64_t key, std::uint32_t layer, std::uint32_t mask) {
  Implementation& i = implementation();
  i.set(key, [&](BodyId id) { i.local.set_layers(id, layer, mask); });
}
void World::set_group(std::uint64_t key, std::uint32_t group) {
  Implementation& i = implementation();
  i.set(key, [&](BodyId id) { i.local.set_group(id, group); });
}
void World::set_motion(std::uint64_t key, Motion motion) {
  Implementation& i = implementation();
  i.set(key, [&](BodyId id) { i.local.set_motion(id, motion); });
}
void World::set_margin(std::uint64_t key, double margin) {
  Implementation& i = implementation();
  i.set(key, [&](BodyId id) { i.local.set_margin(id, margin); });
}
void World::set_rest_offset(std::uint64_t key, std::optional<double> rest_offset) {
  Implementation& i = implementation();
  i.set(key, [&](BodyId id) { i.local.set_rest_offset(id, rest_offset); });
}
void World::set_feature_settings(std::uint64_t key, const FeatureSettings& settings) {
  Implementation& i = implementation();
  OwnBody& body = i.at(key);
  // Answers depend on labels of which some are excluded: with what, this rank's world may not hold.
  const FeatureSettings last = i.local.feature_settings(body.id);
  const bool marks = std::ranges::any_of(HeldBodies::pairs_of(i.held.excluded, key), &ExcludedPair::is_of_labels) &&
                     !(std::ranges::equal(last.vertex_labels, settings.vertex_labels) &&
                       std::ranges::equal(last.facet_labels, settings.facet_labels));
  i.local.set_feature_settings(body.id, settings);
  if (marks) i.parts.mark_moved(body.id, false);
  body.features = ++body.version;
}
void World::set_self_contact(std::uint64_t key, bool wanted) {
  Implementation& i = implementation();
  i.set(key, [&](BodyId id) { i.local.set_self_contact(id, wanted); });
}

void World::set_self_contact_filter(std::uint64_t key, const SelfContactFilter& filter) {
  Implementation& i = implementation();
  i.set(key, [&](BodyId id) { i.local.set_self_contact_filter(id, filter); });
}
void World::set_excluded(std::uint64_t key, std::uint64_t other, bool excluded) {
  Implementation& i = implementation();
  if (!i.held.own.contains(key) && i.held.own.contains(other)) std::swap(key, other);
  i.at(key);
  if (key == other) refuse(ErrorCode::invalid_argument, key_text(key) + ": a pair is of two bodies; see self_contact");
  i.set_excluded({.key = key, .other = other}, excluded);
}

void World::set_excluded_labels(const LabelPair& labels, bool excluded) {
  Implementation& i = implementation();
  const ExcludedPair given{labels.key_a, labels.key_b, labels.label_a, labels.label_b, labels.kind};
  const ExcludedPair pair = i.held.own.contains(given.key) ? given : given.swapped();
  const BodyId own = i.at(pair.key).id, other = i.held.find(pair.other);
  // Refuses labels that are none, and planes, of which every rank has all.
  i.local.excluded_labels({own, pair.label, i.local.contains(other) ? other : own, pair.label_of_other, pair.kind});
  i.set_excluded(pair, excluded);
}

const Report& World::detect() {
  Implementation& i = implementation();
  i.begin(true);
  enum class Reached { nothing, others, end } reached = Reached::nothing;
  std::exception_ptr failure = Channel::failure_of([&] {
    i.parts.set_commit([&](const tact::Report& found) {
      reached = Reached::others;
      i.commit(found);
      reached = Reached::end;
    });
    i.local.detect();
  });
  i.parts.set_commit(nullptr);
  if (reached == Reached::nothing) {  // the others wait for what was found
    Outbox nothing;
    failure = Channel::failure_of([&] { i.channel.deliver(nothing, failure); });
  }
  if (reached != Reached::end) {
    i.start_from_scratch();
    std::rethrow_exception(failure);
  }
  i.end_step();
  if (failure != nullptr) std::rethrow_exception(failure);  // of Settings::on_message
  return i.report;
}

const MotionReport& World::detect_motion(Impacts wanted) {
  Implementation& i = implementation();
  i.begin(false);
  const tact::MotionReport* found = nullptr;
  const std::exception_ptr failure = Channel::failure_of([&] { found = &i.local.detect_motion(wanted); });
  i.channel.gather(0, failure);
  i.finish_motion(*found, wanted);
  return i.motion_report;
}

void World::set_body_state(BodyState state) {
  const int given = (state.pack ? 1 : 0) + (state.unpack ? 1 : 0) + (state.drop ? 1 : 0);
  if (given != 0 && given != 3) refuse(ErrorCode::invalid_argument, "a body's state has some of three functions");
  implementation().body_state = std::move(state);
}

void World::rebalance() {
  Implementation& i = implementation();
  i.settle_names();
  i.rebalance();
}

void World::set_owner(std::uint64_t key, int rank) {
  Implementation& i = implementation();
  i.at(key);
  if (rank < 0 || rank >= i.channel.size())
    refuse(ErrorCode::invalid_argument, key_text(key) + ": there is no rank " + std::to_string(rank));
  i.new_owners[key] = rank;
}

void World::move_bodies() {
  Implementation& i = implementation();
  i.settle_names();
  i.move(i.new_owners);
  i.new_owners.clear();
}

void World::exchange(const std::function<std::vector<std::byte>(std::uint64_t key)>& give,
                     const std::function<void(std::uint64_t key, std::span<const std::byte> bytes)>& take) {
  Implementation& i = implementation();
  if (i.owners_changed)
    refuse(ErrorCode::wrong_order, "bodies have other owners: exchange() goes by the contacts of a detect() since");
  const auto messages = i.channel.exchange([&](Outbox& outbox) {
    std::map<std::uint64_t, std::set<int>> ranks;
    for (const Contact& contact : i.report.contacts()) {
      const BodyPair& bodies = contact.bodies;
      if (bodies.rank_a == bodies.rank_b) continue;
      bodies.rank_a == rank() ? ranks[bodies.key_a].insert(bodies.rank_b) : ranks[bodies.key_b].insert(bodies.rank_a);
    }
    for (const auto& [key, to] : ranks) {
      const Bytes bytes = give(key);
      for (const int other : to) {
        outbox.to(other).put(key);
        outbox.to(other).put_all(bytes);
      }
    }
  });
  i.channel.together([&] {
    std::map<std::uint64_t, std::span<const std::byte>> taken;
    for (const Message& message : messages) {
      for (ByteReader reader(message.bytes); !reader.at_end();) {
        const auto key = reader.get<std::uint64_t>();
        taken[key] = reader.get_bytes();
      }
    }
    for (const auto& [key, bytes] : taken) take(key, bytes);
  });
}

bool World::owns(std::uint64_t key) const noexcept {
  return implementation_ != nullptr && implementation_->held.own.contains(key);
}

std::vector<std::uint64_t> World::bodies() const {
  std::vector<std::uint64_t> keys;
  for (const auto& [key, body] : implementation().held.own) keys.push_back(key);
  return keys;
}

std::size_t World::body_count() const noexcept {
  return implementation_ == nullptr ? 0 : implementation_->held.own.size();
}

BodyId World::id(std::uint64_t key) const {
  Implementation& i = implementation();
  if (const auto shared = i.held.shared.find(key); shared != i.held.shared.end()) return shared->second;
  return i.at(key).id;
}

const tact::World& World::local() const { return implementation().local; }

}  // namespace tact::mpi

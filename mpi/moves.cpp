// Bodies that go to other ranks, with all that is kept of them. What is kept of a pair goes with its host. Nothing
// counts before all bodies have arrived everywhere: until then the old owners have them.
#include <algorithm>
#include <optional>
#include <utility>

#include "mpi/world_implementation.h"

namespace tact::mpi {

/// What leaves this rank, and the pairs whose hosts stay here.
struct World::Implementation::Leaving {
  Shipment shipment;
  std::vector<WaitingPair> left;
};

void put(const SavedPair& pair, ByteWriter& to) {
  to.put(pair.key_a, pair.key_b, pair.birth_a, pair.birth_b, pair.touching);
  to.put_all(pair.bytes);
  to.put_all(pair.patches);
}

SavedPair get_pair(ByteReader& reader) {
  SavedPair pair;
  pair.key_a = reader.get<std::uint64_t>();
  pair.key_b = reader.get<std::uint64_t>();
  pair.birth_a = reader.get<std::uint64_t>();
  pair.birth_b = reader.get<std::uint64_t>();
  pair.touching = reader.get<bool>();
  const auto bytes = reader.get_bytes();
  pair.bytes.assign(bytes.begin(), bytes.end());
  pair.patches = reader.get_all<std::uint64_t>();
  return pair;
}

void World::Implementation::rebalance() {
  std::vector<Site> all;
  channel.together([&] { all = sites(); });
  Goals goals;
  channel.gather(0, Channel::failure_of([&] {
                   const std::vector<int> ranks = partition->cut(all);
                   for (std::size_t i = 0; i < all.size(); ++i) goals[all[i].key] = ranks[i];
                 }));
  needs_near = true;
  move(std::move(goals));
}

void World::Implementation::move(Goals goals) {
  std::erase_if(goals, [&](const auto& goal) { return goal.second == channel.rank(); });
  send_meshes();
  Leaving leaving;
  channel.together([&] { leaving = pack(goals); });
  std::vector<Parcel> parcels;
  channel.gather(0, Channel::failure_of([&] { parcels = partition->send(leaving.shipment); }));
  std::vector<Arrival> arrivals;
  std::optional<Keys> keys;
  const std::exception_ptr failure = Channel::failure_of([&] {
    arrivals.reserve(parcels.size());
    std::vector<std::uint64_t> coming;
    for (const Parcel& parcel : parcels) coming.push_back(parcel.key);
    keys.emplace(coming);
    ghosts_become_own(parcels);
    for (const Parcel& parcel : parcels) unpack(parcel, arrivals);
  });
  try {
    channel.gather(0, failure);
  } catch (...) {
    undo(arrivals);
    throw;
  }
  let_go(goals, std::move(leaving));
  take_in(std::move(arrivals));
  parts.settle();
  // Who has what was found of whom is not followed through several moves: the next step sends it again.
  sent.clear();
  far.clear();
  directory.add(*keys);
  needs_near = owners_changed = true;
}

World::Implementation::Leaving World::Implementation::pack(const Goals& goals) {
  std::vector<BodyId> ids;
  for (const auto& [key, rank] : goals) ids.push_back(at(key).id);
  std::map<std::uint64_t, std::vector<SavedPair>> pairs;
  Leaving leaving;
  for (SavedPair& pair : parts.pairs_of(ids)) {
    const bool has_ended = pair.bytes.empty();
    const std::uint64_t host = has_ended ? pair.key_a : held.host_of(held.find(pair.key_a), held.find(pair.key_b));
    if (goals.contains(host) && !has_ended) {
      pairs[host].push_back(std::move(pair));
    } else {
      leaving.left.push_back({host, std::move(pair)});
    }
  }
  for (const WaitingPair& one : waiting) {
    if (goals.contains(one.host)) pairs[one.host].push_back(one.pair);
  }
  std::map<std::uint64_t, ByteWriter> sent_pairs;
  for (const auto& [keys, one] : sent) {
    for (const std::uint64_t key : {keys.first, keys.second})
      if (goals.contains(key)) sent_pairs[key].put(keys.first, keys.second, one.to);
  }
  std::vector<Parcel> parcels;
  for (const auto& [key, rank] : goals)
    parcels.push_back({key, rank, pack(key, rank, pairs[key], sent_pairs[key].bytes())});
  leaving.shipment = Shipment(std::move(parcels));
  return leaving;
}

Bytes World::Implementation::pack(std::uint64_t key, int to, std::span<const SavedPair> pairs,
                                  std::span<const std::byte> sent_pairs) {
  const OwnBody& body = at(key);
  ByteWriter writer;
  pack_body(key, pairs, writer);
  writer.put(body.version, body.positions, body.features, body.shape);
  const auto stays = [&](const Subscriber& one) { return one.rank != to; };
  writer.put(static_cast<std::uint64_t>(std::ranges::count_if(body.subscribers, stays)));
  for (const Subscriber& one : body.subscribers) {
    if (stays(one)) writer.put(one.rank, one.is_awake, one.version, one.positions, one.features, one.asleep_since);
  }
  writer.put_all(sent_pairs);
  pack_state(key, writer);
  return std::move(writer.bytes());
}

// What is kept of a body and of the pairs that it hosts, whichever rank owns it.
void World::Implementation::pack_body(std::uint64_t key, std::span<const SavedPair> pairs, ByteWriter& to) {
  const OwnBody& body = at(key);
  to.put_all(parts.shape(body.id));
  to.put_all(parts.rest(body.id));
  to.put_all(parts.self_of(body.id));
  to.put(held.at(body.id).order.vertices, body.is_rigid, body.work);
  const std::vector<ExcludedPair> excluded = HeldBodies::pairs_of(held.excluded, key);
  to.put(std::uint64_t{excluded.size()});
  for (const ExcludedPair& pair : excluded) pair.put(to);
  to.put(std::uint64_t{pairs.size()});
  for (const SavedPair& pair : pairs) put(pair, to);
}

void World::Implementation::pack_state(std::uint64_t key, ByteWriter& to) {
  to.put(static_cast<bool>(body_state.pack));
  if (body_state.pack) to.put_all(body_state.pack(key));
}

// Ghosts give way; what is kept of their pairs, whose hosts are here, waits for the next step. Hosts that leave have it
// with them, but for what has ended.
void World::Implementation::ghosts_become_own(std::span<const Parcel> arriving) {
  std::map<std::uint64_t, BodyId> ghosts;
  std::vector<BodyId> ids;
  for (const Parcel& parcel : arriving) {
    held.shapes.erase(parcel.key);
    const auto found = held.ghosts.find(parcel.key);
    if (found == held.ghosts.end()) continue;
    ghosts[parcel.key] = found->second.id;
    ids.push_back(found->second.id);
  }
  if (ids.empty()) return;
  std::vector<WaitingPair> pairs;
  for (SavedPair& pair : parts.pairs_of(ids)) {
    const std::uint64_t host = ghosts.contains(pair.key_a) ? pair.key_b : pair.key_a;
    pairs.push_back({host, std::move(pair)});
  }
  parts.take(ids);
  waiting_of_ghosts = std::move(pairs);
  for (const auto& [key, id] : ghosts) {
    held.drop(id);
    held.ghosts.erase(key);
  }
}

void World::Implementation::unpack(const Parcel& parcel, std::vector<Arrival>& arrivals) {
  ByteReader reader(parcel.bytes);
  Arrival& arrival = unpack_body(parcel.key, reader, arrivals);
  arrival.body.version = reader.get<std::uint64_t>();
  arrival.body.positions = reader.get<std::uint64_t>();
  arrival.body.features = reader.get<std::uint64_t>();
  arrival.body.shape = reader.get<std::uint64_t>();
  for (auto count = reader.get<std::uint64_t>(); count > 0; --count) {
    Subscriber& one = arrival.body.subscribers.emplace_back();
    one.rank = reader.get<int>();
    one.is_awake = reader.get<bool>();
    one.knows_owner = false;
    one.version = reader.get<std::uint64_t>();
    one.positions = reader.get<std::uint64_t>();
    one.features = reader.get<std::uint64_t>();
    one.asleep_since = reader.get<std::uint64_t>();
  }
  for (ByteReader pairs(reader.get_bytes()); !pairs.at_end();) {
    const auto key_a = pairs.get<std::uint64_t>(), key_b = pairs.get<std::uint64_t>();
    arrival.sent.push_back({{key_a, key_b}, pairs.get<int>()});
  }
  if (reader.get<bool>() && body_state.unpack) body_state.unpack(parcel.key, reader.get_bytes());
}

// The reverse of pack_body().
World::Implementation::Arrival& World::Implementation::unpack_body(std::uint64_t key, ByteReader& reader,
                                                                   std::vector<Arrival>& arrivals) {
  const auto shape = reader.get_bytes(), rest = reader.get_bytes(), self = reader.get_bytes();
  const BodyId id = parts.put(shape, rest, false);
  Arrival& arrival = arrivals.emplace_back();
  arrival.key = key;
  arrival.body.id = id;
  held.hold(id, {Held::Role::own, channel.rank(), {reader.get<std::int64_t>(), key}});
  parts.put_self(id, self);
  arrival.body.is_rigid = reader.get<bool>();
  arrival.body.work = reader.get<std::int64_t>();
  for (auto count = reader.get<std::uint64_t>(); count > 0; --count)
    arrival.excluded.push_back(ExcludedPair::get(reader));
  for (auto count = reader.get<std::uint64_t>(); count > 0; --count) arrival.pairs.push_back(get_pair(reader));
  return arrival;
}

void World::Implementation::undo(std::span<const Arrival> arrivals) {
  std::vector<BodyId> ids;
  for (const Arrival& arrival : arrivals) {
    ids.push_back(arrival.body.id);
    held.drop(arrival.body.id);
    if (body_state.drop) body_state.drop(arrival.key);
  }
  parts.take(ids);
  for (WaitingPair& one : waiting_of_ghosts) waiting.push_back(std::move(one));
  waiting_of_ghosts.clear();
  drop_ghosts(true);
}

void World::Implementation::let_go(const Goals& goals, Leaving&& leaving) {
  std::vector<BodyId> ids;
  const auto leaves = [&](const auto& one) {
    return goals.contains(one.first.first) || goals.contains(one.first.second);
  };
  std::erase_if(sent, leaves);  // their hosts leave
  std::erase_if(far, leaves);   // their guests do
  std::erase_if(waiting, [&](const WaitingPair& one) { return goals.contains(one.host); });
  for (WaitingPair& one : leaving.left) waiting.push_back(std::move(one));
  for (const Parcel& parcel : leaving.shipment.parcels) moved_bytes += static_cast<std::int64_t>(parcel.bytes.size());
  moved_bodies += static_cast<std::int64_t>(goals.size());
  for (const auto& [key, rank] : goals) {
    ids.push_back(at(key).id);
    held.drop(at(key).id);
    held.own.erase(key);
    new_owners.erase(key);
    for (const ExcludedPair& pair : HeldBodies::pairs_of(held.excluded, key)) held.set_excluded(pair, false);
    if (body_state.drop) body_state.drop(key);
  }
  parts.take(ids);
}

void World::Implementation::take_in(std::vector<Arrival>&& arrivals) {
  for (Arrival& arrival : arrivals) {
    held.own[arrival.key] = std::move(arrival.body);
    for (SavedPair& pair : arrival.pairs) waiting.push_back({arrival.key, std::move(pair)});
    for (const ExcludedPair& pair : arrival.excluded) held.set_excluded(pair, true);
    for (const auto& [keys, to] : arrival.sent) sent[keys] = {to, false};
  }
  for (const Arrival& arrival : arrivals) {
    for (const ExcludedPair& pair : arrival.excluded) exclude_here(pair, true);
  }
  for (WaitingPair& one : waiting_of_ghosts) {
    if (one.pair.bytes.empty() || held.own.contains(one.host)) waiting.push_back(std::move(one));
  }
  waiting_of_ghosts.clear();
}

}  // namespace tact::mpi

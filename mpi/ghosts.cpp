// Copies of bodies at the ranks of their hosts. A whole body goes once, then its positions when they change; a copy
// that has no host any more sleeps: its shape is kept for a while, for when it comes back.
#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "engine/bodies/columns.h"
#include "mpi/mesh_bytes.h"
#include "mpi/world_implementation.h"

namespace tact::mpi {

namespace {

// Steps for which the shape of a body is kept that is not near.
constexpr std::uint64_t kKeptSteps = 64;

enum class EntryKind : std::uint8_t {
  gone,    ///< the body was removed
  sleep,   ///< it has no host here
  whole,   ///< shape and rest
  wake,    ///< the rest alone
  update,  ///< what changed
  owner,   ///< another rank owns it, which is the sender
};

bool is_kept(const Subscriber& one, std::uint64_t step) { return step - one.asleep_since <= kKeptSteps; }

// What stands in a message after kind and key, skipped or read.
struct Entry {
  EntryKind kind;
  std::uint64_t key;
  std::span<const std::byte> first, second;
};

Entry read_entry(ByteReader& reader) {
  Entry entry{reader.get<EntryKind>(), reader.get<std::uint64_t>(), {}, {}};
  if (entry.kind == EntryKind::whole || entry.kind == EntryKind::wake || entry.kind == EntryKind::update)
    entry.first = reader.get_bytes();
  if (entry.kind == EntryKind::whole) entry.second = reader.get_bytes();
  return entry;
}

tact::PoseUpdate read_pose(ByteReader& reader) {
  tact::PoseUpdate pose;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) pose.rotation(i, k) = reader.get<double>();
    pose.translation[i] = reader.get<double>();
  }
  return pose;
}

// Settings of vertices and facets that came with an update.
struct FeaturesOfGhost {
  std::vector<double> rest_offsets, margins;
  std::vector<std::uint32_t> vertex_labels, facet_labels, vertex_layers, vertex_masks, facet_layers, facet_masks;

  void read(ByteReader& reader) {
    rest_offsets = reader.get_all<double>();
    vertex_labels = reader.get_all<std::uint32_t>();
    facet_labels = reader.get_all<std::uint32_t>();
    vertex_layers = reader.get_all<std::uint32_t>();
    vertex_masks = reader.get_all<std::uint32_t>();
    facet_layers = reader.get_all<std::uint32_t>();
    facet_masks = reader.get_all<std::uint32_t>();
    margins = reader.get_all<double>();
  }
  FeatureSettings view() const {
    return {rest_offsets, vertex_labels, facet_labels, vertex_layers, vertex_masks, facet_layers, facet_masks, margins};
  }
};

template <class Take>
void for_entries(std::span<const Message> messages, const Take& take) {
  for (const Message& message : messages) {
    for (ByteReader reader(message.bytes); !reader.at_end();) take(message.rank, read_entry(reader));
  }
}

}  // namespace

void World::Implementation::write_whole(std::uint64_t key, const OwnBody& body, bool with_shape, ByteWriter& to) {
  const std::size_t before = to.bytes().size();
  ByteWriter rest;
  rest.put(held.at(body.id).order.vertices);
  rest.put_all(parts.rest(body.id));
  to.put(with_shape ? EntryKind::whole : EntryKind::wake, key);
  to.put_all(rest.bytes());
  if (with_shape) to.put_all(parts.shape(body.id));
  (with_shape ? stats.shape_bytes : stats.positions_bytes) += static_cast<std::int64_t>(to.bytes().size() - before);
}

void World::Implementation::write_update(std::uint64_t key, const OwnBody& body, const Subscriber& knows,
                                         ByteWriter& to) {
  const bool with_positions = knows.positions != body.positions, with_features = knows.features != body.features;
  ByteWriter update;
  const broadphase::Filter filter = parts.filter(body.id);
  update.put(filter.layer, filter.mask, filter.group, filter.fixed, local.margin(body.id));
  const std::optional<double> rest_offset = parts.rest_offset(body.id);
  update.put(rest_offset.has_value(), rest_offset.value_or(0.0), parts.moved(body.id), parts.on_its_way(body.id),
             body.is_rigid, with_features);
  if (with_features) {
    const FeatureSettings features = local.feature_settings(body.id);
    update.put_all(features.rest_offsets);
    update.put_all(features.vertex_labels);
    update.put_all(features.facet_labels);
    update.put_all(features.vertex_layers);
    update.put_all(features.vertex_masks);
    update.put_all(features.facet_layers);
    update.put_all(features.facet_masks);
    update.put_all(features.margins);
  }
  update.put(std::uint64_t{body.meshes.size()});
  for (const Bytes& mesh : body.meshes) update.put_all(mesh);
  update.put(with_positions);
  if (with_positions && body.is_rigid) {
    const tact::PoseUpdate pose = parts.pose(body.id);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) update.put(pose.rotation(i, k));
      update.put(pose.translation[i]);
    }
  } else if (with_positions) {
    update.put_all(parts.positions(body.id));
  }
  if (with_positions) stats.positions_bytes += static_cast<std::int64_t>(update.bytes().size());
  to.put(EntryKind::update, key);
  to.put_all(update.bytes());
}

// What each subscriber gets, and what the owner knows of it then.
void World::Implementation::plan(std::uint64_t key, OwnBody& body, bool may_sleep, Outbox& outbox) {
  body.next_subscribers.clear();
  std::vector<int> wanted = body.wanted;
  for (Subscriber one : body.subscribers) {
    const bool is_wanted = std::erase(wanted, one.rank) > 0;
    if (!one.is_awake && !is_wanted) {
      if (is_kept(one, step)) body.next_subscribers.push_back(one);
      continue;
    }
    ByteWriter& to = outbox.to(one.rank);
    if (!one.is_awake) {
      write_whole(key, body, !is_kept(one, step) || one.version < body.shape, to);
      one.is_awake = true;
    } else if (!is_wanted && may_sleep && body.meshes.empty()) {
      to.put(EntryKind::sleep, key);
      one.is_awake = false;
      one.asleep_since = step;
    } else {
      if (!one.knows_owner) to.put(EntryKind::owner, key);
      if (one.version != body.version) write_update(key, body, one, to);
    }
    one.knows_owner = true;
    one.version = body.version, one.positions = body.positions, one.features = body.features;
    body.next_subscribers.push_back(one);
  }
  for (const int rank : wanted) {
    write_whole(key, body, true, outbox.to(rank));
    body.next_subscribers.push_back({.rank = rank,
                                     .is_awake = true,
                                     .version = body.version,
                                     .positions = body.positions,
                                     .features = body.features});
  }
}

void World::Implementation::put_ghost(std::uint64_t key, int owner, std::span<const std::byte> shape,
                                      std::span<const std::byte> rest) {
  if (held.find(key).generation != 0) throw Error(ErrorCode::bad_state, "a rank got a body that it has");
  ByteReader reader(rest);
  const auto vertices = reader.get<std::int64_t>();
  const BodyId id = parts.put(shape, reader.get_bytes(), true);
  held.ghosts[key] = {id, owner};
  held.hold(id, {Held::Role::ghost, owner, {vertices, key}});
  for (const ExcludedPair& pair : HeldBodies::pairs_of(held.excluders, key)) exclude_here(pair.swapped(), true);
}

// First those that go: another body may come with the same key.
bool World::Implementation::take_leaving(std::span<const Message> messages) {
  bool any = false;
  for_entries(messages, [&](int owner, const Entry& entry) {
    if (entry.kind != EntryKind::gone && entry.kind != EntryKind::sleep) return;
    if (entry.kind == EntryKind::gone) held.shapes.erase(entry.key);
    const auto ghost = held.ghosts.find(entry.key);
    if (ghost == held.ghosts.end()) return;
    const BodyId id = ghost->second.id;
    if (entry.kind == EntryKind::sleep) held.shapes[entry.key] = {parts.shape(id), step};
    held.gone[id] = {entry.key, owner, entry.kind == EntryKind::gone};
    parts.remove_copy(id);
    held.drop(id);
    held.ghosts.erase(ghost);
    any = true;
  });
  return any;
}

bool World::Implementation::take_coming(std::span<const Message> messages) {
  bool any = false;
  // An owner that is new, or was another in between, has nothing of what was found.
  std::set<std::uint64_t> renewed;
  for_entries(messages, [&](int, const Entry& entry) {
    if (entry.kind == EntryKind::whole || entry.kind == EntryKind::wake || entry.kind == EntryKind::owner)
      renewed.insert(entry.key);
  });
  for (auto& [keys, one] : sent) {
    if (renewed.contains(keys.first) || renewed.contains(keys.second)) one.by_this_rank = false;
  }
  for_entries(messages, [&](int rank, const Entry& entry) {
    if (entry.kind != EntryKind::whole && entry.kind != EntryKind::wake) return;
    if (entry.kind == EntryKind::whole) {
      put_ghost(entry.key, rank, entry.second, entry.first);
    } else {
      put_ghost(entry.key, rank, held.shapes.at(entry.key).bytes, entry.first);
    }
    held.shapes.erase(entry.key);
    any = true;
  });
  std::erase_if(held.shapes, [&](const auto& shape) { return step - shape.second.asleep_since > kKeptSteps; });
  return any;
}

// Positions of all at once, once none of them is fixed; then what else changed.
void World::Implementation::take_updates(std::span<const Message> messages) {
  std::vector<std::vector<double>> positions;
  std::vector<std::pair<BodyId, std::size_t>> moved;
  std::vector<std::function<void()>> rest;
  for_entries(messages, [&](int rank, const Entry& entry) {
    if (entry.kind != EntryKind::update && entry.kind != EntryKind::owner) return;
    Ghost& ghost = held.ghosts.at(entry.key);
    const BodyId id = ghost.id;
    if (entry.kind == EntryKind::owner) {
      ghost.owner = rank;
      return held.set_owner(id, rank);
    }
    ByteReader reader(entry.first);
    const auto layer = reader.get<std::uint32_t>(), mask = reader.get<std::uint32_t>();
    const auto group = reader.get<std::uint32_t>();
    const auto is_fixed = reader.get<bool>();
    const auto margin = reader.get<double>();
    const auto has_rest_offset = reader.get<bool>();
    const auto rest_offset = reader.get<double>();
    const auto is_moved = reader.get<bool>(), is_on_its_way = reader.get<bool>(), is_rigid = reader.get<bool>();
    const auto has_features = reader.get<bool>();
    FeaturesOfGhost features;
    if (has_features) features.read(reader);
    for (auto count = reader.get<std::uint64_t>(); count > 0; --count)
      local.set_facets(id, MeshOfBytes(reader.get_bytes()).update());
    const auto has_positions = reader.get<bool>();
    const Motion motion = is_rigid ? Motion::rigid : Motion::deformable;
    if (has_positions) local.set_motion(id, motion);
    if (has_positions && is_rigid) {
      const tact::PoseUpdate pose = read_pose(reader);
      local.set_pose(id, pose.rotation, pose.translation);
    } else if (has_positions) {
      moved.push_back({id, positions.size()});
      positions.push_back(reader.get_all<double>());
    }
    rest.push_back([=, this] {
      // Of a body that has not moved since the last step no more than its labels is new.
      if (!is_moved && has_features) local.set_feature_settings(id, features.view());
      if (!is_moved) return;
      local.set_layers(id, layer, mask);
      local.set_group(id, group);
      if (has_features) local.set_feature_settings(id, {});
      local.set_rest_offset(id, std::nullopt);
      local.set_margin(id, margin);
      if (has_rest_offset) local.set_rest_offset(id, rest_offset);
      if (has_features) local.set_feature_settings(id, features.view());
      local.set_motion(id, is_fixed ? Motion::fixed : motion);
      parts.mark_moved(id, is_on_its_way);
    });
  });
  std::vector<tact::PositionsUpdate> updates;
  for (const auto& [id, place] : moved) updates.push_back({id, columns_of<Positions>(positions[place])});
  local.set_positions(updates);
  for (const auto& set : rest) set();
}

void World::Implementation::send_ghosts(bool may_sleep) {
  if (may_sleep) ++step;
  const auto messages = channel.exchange([&](Outbox& outbox) {
    for (const auto& [key, subscribers] : removed) {
      for (const Subscriber& one : subscribers) outbox.to(one.rank).put(EntryKind::gone, key);
    }
    for (auto& [key, body] : held.own) plan(key, body, may_sleep, outbox);
  });
  removed.clear();
  for (auto& [key, body] : held.own) {
    std::swap(body.subscribers, body.next_subscribers);
    body.meshes.clear();
  }
  const std::exception_ptr failure = Channel::failure_of([&] {
    const bool any_left = take_leaving(messages), any_came = take_coming(messages);
    take_updates(messages);
    ended_waiting.clear();
    const bool any_waited = may_sleep && !waiting.empty();
    if (may_sleep) place_waiting();
    if (any_left || any_came || any_waited) parts.settle();
  });
  try {
    channel.gather(0, failure);
  } catch (...) {
    drop_ghosts(true);
    throw;
  }
  stats.ghosts = static_cast<std::int64_t>(held.ghosts.size());
  if (may_sleep && std::exchange(owners_changed, false)) find_owners_of_ended();
}

// Before bodies move or are saved, all copies get the facets of their bodies: what is kept of a pair goes by them.
void World::Implementation::send_meshes() {
  const auto has_changes = [](const auto& own) { return !own.second.meshes.empty(); };
  std::array<std::uint64_t, 1> any{std::ranges::any_of(held.own, has_changes)};
  channel.largest(any);
  if (any[0] != 0) send_ghosts(false);
}

// What is kept of pairs whose guest is here now; the others have ended.
void World::Implementation::place_waiting() {
  VertexNumbers numbers;
  for (WaitingPair& one : waiting) {
    if (parts.put(one.pair, numbers)) continue;
    ended_waiting.push_back(
        {one.keys(), one.pair.touching, one.pair.patches, one.pair.birth_a == 0, one.pair.birth_b == 0});
  }
  waiting.clear();
}

// The guests of pairs that ended while they were on their way: whose they are is not known here.
void World::Implementation::find_owners_of_ended() {
  std::vector<std::uint64_t> keys;
  std::optional<Keys> wanted;
  channel.together([&] {
    for (const EndedPair& pair : ended_waiting) keys.insert(keys.end(), {pair.keys.first, pair.keys.second});
    wanted.emplace(keys);
  });
  directory.find(*wanted);
  owners_of_ended.clear();
  channel.together([&] {
    for (std::size_t i = 0; i < keys.size(); ++i) owners_of_ended[keys[i]] = wanted->owners()[i];
  });
}

// Without a ghost the ranks agree on what each has. What is kept of their pairs waits for them, or is given up.
void World::Implementation::drop_ghosts(bool keep_pairs) {
  std::vector<BodyId> ids;
  for (const auto& [key, ghost] : held.ghosts) ids.push_back(ghost.id);
  if (keep_pairs) {
    for (SavedPair& pair : parts.pairs_of(ids)) {
      const std::uint64_t host = held.own.contains(pair.key_a) ? pair.key_a : pair.key_b;
      waiting.push_back({host, std::move(pair)});
    }
  }
  parts.take(ids);
  for (const BodyId id : ids) held.drop(id);
  held.ghosts.clear();
  held.shapes.clear();
  for (auto& [key, body] : held.own) body.subscribers.clear();
  parts.settle();
  sends_all = needs_near = owners_changed = true;
}

// After a step that failed on any rank: bodies stay.
void World::Implementation::start_from_scratch() {
  parts.forget_step();
  waiting.clear();
  ended_waiting.clear();
  sent.clear();
  far.clear();
  drop_ghosts(false);
}

}  // namespace tact::mpi

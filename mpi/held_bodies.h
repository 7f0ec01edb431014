// The bodies that a rank holds: its own, copies of those of others that are near (ghosts), and those that every rank
// holds. Which of two bodies hosts the other: their pair is looked at by the owner of the host.
#pragma once

#include <tact/body.h>

#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/hash.h"
#include "engine/bodies/pair_choice.h"
#include "mpi/bytes.h"

namespace tact::mpi {

/// What decides which of two bodies is the host: the larger one, so that the smaller one travels. Of equal ones, by a
/// hash of the keys, so that neighbouring ranks share the pairs between them. It goes with the body and stays as it was
/// when the body was added: what is kept of a pair stays with its host.
struct HostOrder {
  std::int64_t vertices = 0;
  std::uint64_t key = 0;
  bool hosts(const HostOrder& other) const {
    const auto order = [](const HostOrder& one) { return std::tuple(one.vertices, base::mixed(one.key), one.key); };
    return order(other) < order(*this);
  }
};

/// A rank that has or had a copy of a body, as the owner knows it.
struct Subscriber {
  int rank = 0;
  bool is_awake = false;        ///< its copy takes part; else it has the shape alone
  bool knows_owner = true;      ///< that this rank owns the body now
  std::uint64_t version = 0;    ///< the body's when something was last sent
  std::uint64_t positions = 0;  ///< and when its positions were
  std::uint64_t features = 0;   ///< and when the settings of its vertices and facets were
  std::uint64_t asleep_since = 0;
};

struct OwnBody {
  BodyId id;
  bool is_rigid = false;           ///< takes poses
  std::uint64_t version = 1;       ///< counts changes
  std::uint64_t positions = 1;     ///< those of positions and poses
  std::uint64_t features = 1;      ///< those of settings of vertices and facets
  std::uint64_t shape = 1;         ///< those of facets
  std::vector<Bytes> meshes = {};  ///< the changes of facets that its copies do not have, in order
  std::vector<Subscriber> subscribers = {};
  std::vector<Subscriber> next_subscribers = {};  ///< once the messages have arrived
  std::vector<int> wanted = {};                   ///< ranks that have a host near it, ascending
  std::int64_t work = 0;                          ///< of the last step
};

struct Ghost {
  BodyId id;
  int owner = 0;
};

/// The shape of a body that was near.
struct KeptShape {
  Bytes bytes;
  std::uint64_t asleep_since = 0;
};

/// What a slot of the rank's world holds.
struct Held {
  enum class Role : std::uint8_t { none, own, ghost, shared };
  Role role = Role::none;
  int owner = -1;
  HostOrder order;
};

/// Two keys, the smaller one first.
using KeyPair = std::pair<std::uint64_t, std::uint64_t>;

/// What is excluded by name, as the owner of the first body has it: two bodies, or features of two labels of them.
struct ExcludedPair {
  std::uint64_t key = 0, other = 0;
  std::uint32_t label = 0, label_of_other = 0;  ///< 0 of the bodies themselves
  LabelKind kind = LabelKind::facet;

  bool is_of_labels() const { return label != 0; }
  ExcludedPair swapped() const { return {other, key, label_of_other, label, kind}; }
  void put(ByteWriter& to) const { to.put(key, other, label, label_of_other, kind); }
  static ExcludedPair get(ByteReader& from) {
    ExcludedPair pair{.key = from.get<std::uint64_t>(), .other = from.get<std::uint64_t>()};
    pair.label = from.get<std::uint32_t>(), pair.label_of_other = from.get<std::uint32_t>();
    pair.kind = from.get<LabelKind>();
    return pair;
  }
  friend auto operator<=>(const ExcludedPair&, const ExcludedPair&) = default;
};

class HeldBodies final : public PairChoice {
 public:
  std::map<std::uint64_t, OwnBody> own;
  std::map<std::uint64_t, Ghost> ghosts;
  std::map<std::uint64_t, KeptShape> shapes;
  std::map<std::uint64_t, BodyId> shared;
  /// A body that went since the last step; the owner of a ghost, or -1.
  struct Gone {
    std::uint64_t key = 0;
    int owner = -1;
    bool is_removed = false;
  };
  std::map<BodyId, Gone> gone;

  bool looks_at(std::uint32_t a, std::uint32_t b) const override {
    const Held &x = by_slot_[a], &y = by_slot_[b];
    if (x.role != Held::Role::own && y.role != Held::Role::own) return false;
    if (x.role == Held::Role::ghost) return y.order.hosts(x.order);
    if (y.role == Held::Role::ghost) return x.order.hosts(y.order);
    return true;
  }

  /// The key of the host of two bodies, one of which is of this rank.
  std::uint64_t host_of(BodyId a, BodyId b) const {
    const Held &x = at(a), &y = at(b);
    if (x.role != Held::Role::own) return y.order.key;
    if (y.role != Held::Role::own) return x.order.key;
    return x.order.hosts(y.order) ? x.order.key : y.order.key;
  }

  void hold(BodyId id, const Held& held) {
    if (by_slot_.size() <= id.index) by_slot_.resize(id.index + std::size_t{1});
    by_slot_[id.index] = held;
  }
  void drop(BodyId id) { by_slot_[id.index] = {}; }
  void set_owner(BodyId ghost, int owner) { by_slot_[ghost.index].owner = owner; }
  const Held& at(BodyId id) const { return by_slot_[id.index]; }

  /// The body of this key in the rank's world, or the id of no body.
  BodyId find(std::uint64_t key) const {
    if (const auto found = own.find(key); found != own.end()) return found->second.id;
    if (const auto found = shared.find(key); found != shared.end()) return found->second;
    const auto found = ghosts.find(key);
    return found != ghosts.end() ? found->second.id : BodyId{};
  }

  /// What is excluded by name, of an own body and another; `excluders` the other way round.
  std::set<ExcludedPair> excluded, excluders;
  void set_excluded(const ExcludedPair& pair, bool wanted) {
    if (wanted) {
      excluded.insert(pair), excluders.insert(pair.swapped());
    } else {
      excluded.erase(pair), excluders.erase(pair.swapped());
    }
  }
  /// The pairs that begin with a key.
  static std::vector<ExcludedPair> pairs_of(const std::set<ExcludedPair>& pairs, std::uint64_t key) {
    std::vector<ExcludedPair> found;
    for (auto at = pairs.lower_bound({.key = key}); at != pairs.end() && at->key == key; ++at) found.push_back(*at);
    return found;
  }

 private:
  std::vector<Held> by_slot_;
};

}  // namespace tact::mpi

// What all ranks settle before a call together: whose keys are whose, which pairs are excluded, whether anything moved.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "mpi/world_implementation.h"

namespace tact::mpi {

// Ends with ghosts as their owners have them, and what is kept of pairs where it belongs.
bool World::Implementation::begin(bool for_step) {
  channel.reset_counts();
  stats = {};
  const std::uint64_t of_shared = hash_of_shared();
  std::array<std::uint64_t, 6> all{parts.any_moved() || !removed.empty(),
                                   !new_keys.empty() || !gone_keys.empty(),
                                   !exclusions.empty(),
                                   of_shared,
                                   ~of_shared,
                                   lost_ghost};
  channel.largest(all);
  if (all[3] != ~all[4])
    throw Error(ErrorCode::invalid_argument, "the ranks hold different bodies that every rank should hold");
  new_shared.clear();
  removed_shared = 0;
  if (all[5] != 0) drop_ghosts(true);
  lost_ghost = false;
  if (all[1] != 0) update_directory();
  if (all[2] != 0) send_exclusions();
  if (for_step && settings.rebalance_above > 0.0 && imbalance > settings.rebalance_above) rebalance();
  const bool any_moved = all[0] != 0 || all[2] != 0;
  if (!any_moved && !needs_near) return false;
  find_near(!for_step);
  send_ghosts(for_step);
  if (for_step) needs_near = false;  // what is kept of pairs that moved waits for a step
  return true;
}

// A key that has an owner is found before it is added; of keys that two ranks add at once, one finds the other's after.
void World::Implementation::update_directory() {
  std::optional<Keys> gone, come;
  channel.together([&] {
    gone.emplace(gone_keys);
    come.emplace(new_keys);
  });
  directory.remove(*gone);
  gone_keys.clear();
  const auto check = [&] {
    directory.find(*come);
    return Channel::failure_of([&] {
      for (std::size_t i = 0; i < new_keys.size(); ++i) {
        const int owner = come->owners()[i];
        if (owner != -1 && owner != channel.rank())
          throw Error(ErrorCode::invalid_argument, "ranks " + std::to_string(owner) + " and " +
                                                       std::to_string(channel.rank()) + " each own a body of key " +
                                                       std::to_string(new_keys[i]));
      }
    });
  };
  bool is_added = false;
  try {
    channel.gather(0, check());
    directory.add(*come);
    is_added = true;
    channel.gather(0, check());
  } catch (...) {
    if (is_added) directory.remove(*come);
    drop_ghosts(true);  // those of the keys were given up
    throw;
  }
  new_keys.clear();
}

void World::Implementation::send_exclusions() {
  std::optional<Keys> others;
  channel.together([&] {
    std::vector<std::uint64_t> keys;
    for (const Exclusion& one : exclusions) keys.push_back(one.pair.other);
    others.emplace(keys);
  });
  directory.find(*others);
  const std::span<const int> owners = others->owners();
  channel.together([&] { check_exclusions(owners); });
  const auto messages = channel.exchange([&](Outbox& outbox) {
    for (std::size_t i = 0; i < exclusions.size(); ++i) {
      const auto put_to = [&](int rank) { exclusions[i].put(outbox.to(rank)); };
      if (held.shared.contains(exclusions[i].pair.other)) {
        for (int rank = 0; rank < channel.size(); ++rank) put_to(rank);
      } else if (owners[i] >= 0) {
        put_to(owners[i]);
      }
    }
  });
  channel.together([&] {
    std::vector<Exclusion> come;
    for (const Message& message : messages) {
      for (ByteReader reader(message.bytes); !reader.at_end();) come.push_back(Exclusion::get(reader));
    }
    // Those of removed bodies first: another may have come with the key of one.
    std::ranges::stable_sort(come, {}, &Exclusion::marks);
    for (const Exclusion& one : come) {
      if (const auto shared = held.shared.find(one.pair.other); shared != held.shared.end()) {
        if (one.marks) parts.mark_moved(shared->second, false);
      } else if (held.own.contains(one.pair.other)) {
        exclude(one.pair.swapped(), one.wanted, one.marks);
      }
    }
  });
  exclusions.clear();  // if anything failed they are sent again
}

// Takes back what names a body that nobody owns, and throws then.
void World::Implementation::check_exclusions(std::span<const int> owners) {
  std::vector<Exclusion> others;
  std::optional<std::uint64_t> unknown;
  for (std::size_t i = 0; i < exclusions.size(); ++i) {
    const Exclusion& one = exclusions[i];
    if (held.shared.contains(one.pair.other) || owners[i] >= 0 || !one.marks) {
      others.push_back(one);
      continue;
    }
    unknown = one.pair.other;
    if (held.own.contains(one.pair.key)) exclude(one.pair, false, false);
  }
  if (!unknown) return;
  exclusions = std::move(others);
  throw Error(ErrorCode::stale_body,
              "nobody owns a body of key " + std::to_string(*unknown) + ", which was to be excluded");
}

void World::Implementation::settle_names() {
  update_directory();
  std::array<std::uint64_t, 1> any{!exclusions.empty()};
  channel.largest(any);
  if (any[0] == 0) return;
  send_exclusions();
  needs_near = true;
}

}  // namespace tact::mpi

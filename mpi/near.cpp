// Which bodies are near bodies of other ranks: boxes meet at the ranks that Zoltan names for them, whoever owns the
// bodies, and the owner of a guest learns which ranks host it.
#include <algorithm>

#include "mpi/world_implementation.h"

namespace tact::mpi {

namespace {

// A box at the rank where it is compared.
struct Compared {
  int owner = 0;
  HostOrder order;
};

void put(ByteWriter& to, const HostOrder& order, const base::Box& box, const broadphase::Filter& filter) {
  to.put(order.key, order.vertices, filter.layer, filter.mask, filter.group, filter.fixed);
  for (int axis = 0; axis < 3; ++axis) to.put(box.lower[axis], box.upper[axis]);
}

// A guest and the rank of its host.
struct Near {
  std::uint64_t key;
  int rank;
  friend auto operator<=>(const Near&, const Near&) = default;
};

void sort_unique(auto& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Of what came to this rank: the guests of each owner.
std::map<int, std::vector<Near>> compare(std::span<const Message> messages, int threads, Statistics& stats) {
  std::vector<base::Box> boxes;
  std::vector<broadphase::Filter> filters;
  std::vector<Compared> bodies;
  for (const Message& message : messages) {
    for (ByteReader reader(message.bytes); !reader.at_end();) {
      Compared& body = bodies.emplace_back();
      body.owner = message.rank;
      body.order.key = reader.get<std::uint64_t>();
      body.order.vertices = reader.get<std::int64_t>();
      broadphase::Filter& filter = filters.emplace_back();
      filter.layer = reader.get<std::uint32_t>();
      filter.mask = reader.get<std::uint32_t>();
      filter.group = reader.get<std::uint32_t>();
      filter.fixed = reader.get<bool>();
      base::Box& box = boxes.emplace_back();
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = reader.get<double>();
        box.upper[axis] = reader.get<double>();
      }
    }
  }
  stats.boxes = static_cast<std::int64_t>(boxes.size());
  std::map<int, std::vector<Near>> near;
  const auto is_other = [&](const Compared& body) { return body.owner != bodies.front().owner; };
  if (std::ranges::none_of(bodies, is_other)) return near;
  for (const broadphase::IndexPair& pair : WorldParts::overlapping(boxes, filters, threads)) {
    const Compared &a = bodies[pair.a], &b = bodies[pair.b];
    if (a.owner == b.owner) continue;
    const auto& [guest, host] = a.order.hosts(b.order) ? std::tie(b, a) : std::tie(a, b);
    near[guest.owner].push_back({guest.order.key, host.owner});
  }
  for (auto& [owner, list] : near) sort_unique(list);
  return near;
}

}  // namespace

std::vector<Site> World::Implementation::sites() const {
  std::vector<Site> all;
  for (const auto& [key, body] : held.own) {
    Site& site = all.emplace_back();
    site.key = key;
    site.work = static_cast<double>(std::max<std::int64_t>(body.work, 1));
    const base::Box box = parts.box(body.id);
    for (int axis = 0; axis < 3 && !box.empty(); ++axis) site.middle[axis] = 0.5 * (box.lower[axis] + box.upper[axis]);
  }
  return all;
}

// Bodies stay where they are: it is only settled who compares which boxes.
void World::Implementation::cut_if_new() {
  if (partition->is_cut()) return;
  std::vector<Site> all;
  channel.together([&] { all = sites(); });
  const std::exception_ptr failure = Channel::failure_of([&] { partition->cut(all); });
  channel.gather(0, failure);
}

void World::Implementation::find_near(bool by_ways) {
  cut_if_new();
  const std::int64_t before = channel.bytes();
  const auto boxes = channel.exchange([&](Outbox& outbox) {
    std::vector<int> ranks;
    for (const auto& [key, body] : held.own) {
      const base::Box box = by_ways ? parts.way_box(body.id) : parts.box(body.id);
      if (box.empty()) continue;
      partition->ranks_near(box, ranks);
      for (const int rank : ranks) put(outbox.to(rank), held.at(body.id).order, box, parts.filter(body.id));
    }
  });
  const auto lists = channel.exchange([&](Outbox& outbox) {
    for (const auto& [owner, list] : compare(boxes, local.settings().threads, stats)) {
      for (const Near& near : list) outbox.to(owner).put(near.key, near.rank);
    }
  });
  channel.together([&] {
    for (auto& [key, body] : held.own) body.wanted.clear();
    for (const Message& message : lists) {
      for (ByteReader reader(message.bytes); !reader.at_end();) {
        const auto key = reader.get<std::uint64_t>();
        held.own.at(key).wanted.push_back(reader.get<int>());
      }
    }
    for (auto& [key, body] : held.own) sort_unique(body.wanted);
  });
  stats.box_bytes += channel.bytes() - before;
}

}  // namespace tact::mpi

// What a step found: a pair is looked at by one rank, and the owner of the guest gets the result. It keeps it until
// another comes, as pairs that do not move are not looked at.
#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <tuple>
#include <utility>

#include "mpi/world_implementation.h"

namespace tact::mpi {

namespace {

enum class ResultKind : std::uint8_t { contact, no_contact, began, ended, patch };

KeyPair keys_of(const BodyPair& bodies) { return {bodies.key_a, bodies.key_b}; }

// `counted` by the rank that gets them: else by this one.
void put(ByteWriter& to, const BodyPair& bodies, bool counted = false) {
  to.put(bodies.key_a, bodies.key_b, bodies.rank_a, bodies.rank_b, counted);
}

BodyPair get_bodies(ByteReader& reader) {
  BodyPair bodies;
  bodies.key_a = reader.get<std::uint64_t>();
  bodies.key_b = reader.get<std::uint64_t>();
  bodies.rank_a = reader.get<int>();
  bodies.rank_b = reader.get<int>();
  bodies.counted = reader.get<bool>();
  return bodies;
}

void put(ByteWriter& to, ResultKind kind, const BodyPair& bodies, bool counted = false) {
  to.put(kind);
  put(to, bodies, counted);
}

void put_patch(ByteWriter& to, const BodyPair& bodies, tact::PatchEvent::Kind kind, std::uint64_t patch,
               std::uint64_t other, bool counted = false) {
  put(to, ResultKind::patch, bodies, counted);
  to.put(kind, patch, other);
}

}  // namespace

void ReportBuilder::clear(Report& report) {
  report.contacts_.clear();
  report.began_.clear();
  report.ended_.clear();
  report.patch_events_.clear();
}

void ReportBuilder::clear(MotionReport& report) { report.impacts_.clear(); }

void ReportBuilder::sort(Report& report) {
  const auto by_keys = [](const auto& one) { return keys_of(one.bodies); };
  std::ranges::sort(report.contacts_, {}, by_keys);
  std::ranges::sort(report.began_, {}, by_keys);
  std::ranges::sort(report.ended_, {}, by_keys);
  std::ranges::sort(report.patch_events_, {}, [](const PatchEvent& event) {
    const bool is_new = event.kind == tact::PatchEvent::Kind::began || event.kind == tact::PatchEvent::Kind::split;
    return std::tuple(keys_of(event.bodies), is_new, event.patch);
  });
}

const Contact* Report::find_contact(std::uint64_t a, std::uint64_t b) const noexcept {
  const KeyPair keys = std::minmax(a, b);
  const auto found =
      std::ranges::lower_bound(contacts_, keys, {}, [](const Contact& contact) { return keys_of(contact.bodies); });
  return found != contacts_.end() && keys_of(found->bodies) == keys ? &*found : nullptr;
}

std::uint64_t Report::hash_sum() const {
  std::uint64_t sum = 0;
  for (const Contact& contact : contacts_) sum += contact.bodies.counted ? contact.contact.hash() : 0;
  return sum;
}

// Of a pair that this rank looked at: it counts it.
BodyPair World::Implementation::named(BodyId a, BodyId b) const {
  const auto name = [&](BodyId id) -> std::pair<std::uint64_t, int> {
    if (const auto gone = held.gone.find(id); gone != held.gone.end())
      return {gone->second.key, gone->second.is_removed ? -1 : gone->second.owner};
    return {held.at(id).order.key, held.at(id).owner};
  };
  const auto [key_a, rank_a] = name(a);
  const auto [key_b, rank_b] = name(b);
  return {key_a, key_b, rank_a, rank_b, true};
}

// A pair that ended while a body of it was on its way. This rank counts it, if it owns one of the two or nobody does.
BodyPair World::Implementation::named(const EndedPair& pair) const {
  const auto owner = [&](std::uint64_t key) {
    if (held.shared.contains(key)) return channel.rank();
    const auto found = owners_of_ended.find(key);
    return found == owners_of_ended.end() ? -1 : found->second;
  };
  const int rank_a = pair.is_removed_a ? -1 : owner(pair.keys.first);
  const int rank_b = pair.is_removed_b ? -1 : owner(pair.keys.second);
  const bool counted = rank_a == channel.rank() || rank_b == channel.rank() || (rank_a < 0 && rank_b < 0);
  return {pair.keys.first, pair.keys.second, rank_a, rank_b, counted};
}

// The owner of the ghost among two bodies, or -1.
int World::Implementation::guest_owner(BodyId a, BodyId b) const {
  for (const BodyId id : {a, b}) {
    const auto gone = held.gone.find(id);
    const int owner = gone != held.gone.end() ? gone->second.owner : held.at(id).owner;
    if (owner >= 0 && owner != channel.rank()) return owner;
  }
  return -1;
}

void World::Implementation::send_results(const tact::Report& found, Outbox& outbox,
                                         std::map<KeyPair, Sent>& next_sent) {
  for (const tact::Contact& contact : found.contacts()) {
    const int to = guest_owner(contact.a, contact.b);
    if (to < 0) continue;
    const BodyPair bodies = named(contact.a, contact.b);
    next_sent[keys_of(bodies)] = {to, true};
    const auto last = sent.find(keys_of(bodies));
    const bool is_known = last != sent.end() && last->second.to == to && last->second.by_this_rank;
    if (is_known && !sends_all && !parts.moved(contact.a) && !parts.moved(contact.b)) continue;
    put(outbox.to(to), ResultKind::contact, bodies);
    outbox.to(to).put_all(WorldParts::contact_bytes(contact));
  }
  for (const auto& [keys, one] : sent) {
    if (!next_sent.contains(keys)) put(outbox.to(one.to), ResultKind::no_contact, {keys.first, keys.second});
  }
  const auto put_event = [&](const tact::ContactEvent& event, ResultKind kind) {
    if (const int to = guest_owner(event.a, event.b); to >= 0) put(outbox.to(to), kind, named(event.a, event.b));
  };
  for (const tact::ContactEvent& event : found.began()) put_event(event, ResultKind::began);
  for (const tact::ContactEvent& event : found.ended()) put_event(event, ResultKind::ended);
  for (const tact::PatchEvent& event : found.patch_events()) {
    if (const int to = guest_owner(event.a, event.b); to >= 0)
      put_patch(outbox.to(to), named(event.a, event.b), event.kind, event.patch, event.other);
  }
  for (const EndedPair& pair : ended_waiting) {
    const BodyPair bodies = named(pair);
    for (const int to : std::set{bodies.rank_a, bodies.rank_b}) {
      if (to < 0 || to == channel.rank()) continue;
      const bool counts = !bodies.counted && to == (bodies.rank_a >= 0 ? bodies.rank_a : bodies.rank_b);
      put(outbox.to(to), ResultKind::no_contact, bodies);
      if (pair.touched) put(outbox.to(to), ResultKind::ended, bodies, counts);
      for (const std::uint64_t patch : pair.patches)
        put_patch(outbox.to(to), bodies, tact::PatchEvent::Kind::ended, patch, 0, counts);
    }
  }
}

// A contact that is gone may be of a body whose key another has since, with a contact of its own.
void World::Implementation::take_results(std::span<const Message> messages) {
  std::vector<std::pair<BodyPair, std::span<const std::byte>>> contacts;
  for (const Message& message : messages) {
    for (ByteReader reader(message.bytes); !reader.at_end();) {
      const auto kind = reader.get<ResultKind>();
      const BodyPair bodies = get_bodies(reader);
      switch (kind) {
        case ResultKind::contact: contacts.push_back({bodies, reader.get_bytes()}); break;
        case ResultKind::no_contact: far.erase(keys_of(bodies)); break;
        case ResultKind::began: ReportBuilder::began(next_report).push_back({bodies}); break;
        case ResultKind::ended: ReportBuilder::ended(next_report).push_back({bodies}); break;
        case ResultKind::patch: {
          const auto what = reader.get<tact::PatchEvent::Kind>();
          const auto patch = reader.get<std::uint64_t>(), other = reader.get<std::uint64_t>();
          ReportBuilder::patch_events(next_report).push_back({bodies, what, patch, other});
          break;
        }
      }
    }
  }
  for (const auto& [bodies, bytes] : contacts) far[keys_of(bodies)] = {bodies, WorldParts::contact_of(bytes)};
}

void World::Implementation::build_report(const tact::Report& found) {
  std::vector<Contact>& contacts = ReportBuilder::contacts(next_report);
  for (const tact::Contact& contact : found.contacts()) contacts.push_back({named(contact.a, contact.b), contact});
  // A guest may have gone to the rank of its host, or to another.
  std::erase_if(
      far, [&](const auto& one) { return held.own.contains(one.first.first) == held.own.contains(one.first.second); });
  for (auto& [keys, one] : far) {
    tact::Contact& contact = one.found.contact;
    contact.a = held.find(keys.first), contact.b = held.find(keys.second);
    contacts.push_back({one.bodies, contact});
  }
  for (const tact::ContactEvent& event : found.began())
    ReportBuilder::began(next_report).push_back({named(event.a, event.b)});
  for (const tact::ContactEvent& event : found.ended())
    ReportBuilder::ended(next_report).push_back({named(event.a, event.b)});
  for (const tact::PatchEvent& event : found.patch_events())
    ReportBuilder::patch_events(next_report).push_back({named(event.a, event.b), event.kind, event.patch, event.other});
  for (const EndedPair& pair : ended_waiting) {
    const BodyPair bodies = named(pair);
    if (!bodies.counted) continue;  // the owners tell
    if (pair.touched) ReportBuilder::ended(next_report).push_back({bodies});
    for (const std::uint64_t patch : pair.patches)
      ReportBuilder::patch_events(next_report).push_back({bodies, tact::PatchEvent::Kind::ended, patch, 0});
  }
  ReportBuilder::sort(next_report);
}

// Of each pair to its host, which decides where the pair is looked at.
void World::Implementation::count_work(const tact::Report& found) {
  constexpr std::int64_t kPair = 8, kContact = 32, kPoint = 4;
  for (auto& [key, body] : held.own) body.work = held.at(body.id).order.vertices;
  const auto work_of = [&](BodyId a, BodyId b) -> std::int64_t& { return held.own.at(held.host_of(a, b)).work; };
  for (const CandidatePair& pair : found.candidate_pairs()) work_of(pair.a, pair.b) += kPair;
  for (const tact::Contact& contact : found.contacts()) {
    work_of(contact.a, contact.b) += kContact + contact.kept_facets_a + contact.kept_facets_b +
                                     static_cast<std::int64_t>(contact.facet_pairs().size()) +
                                     kPoint * static_cast<std::int64_t>(contact.points().size());
  }
  stats.pairs = static_cast<std::int64_t>(found.candidate_pairs().size());
}

std::uint64_t World::Implementation::own_work() const {
  std::uint64_t sum = 0;
  for (const auto& [key, body] : held.own) sum += static_cast<std::uint64_t>(body.work);
  return sum;
}

Statistics World::Implementation::finished_stats() {
  stats.own_bodies = static_cast<std::int64_t>(held.own.size());
  stats.shared_bodies = static_cast<std::int64_t>(held.shared.size());
  stats.ghosts = static_cast<std::int64_t>(held.ghosts.size());
  stats.kept_shapes = static_cast<std::int64_t>(held.shapes.size());
  stats.far_contacts = static_cast<std::int64_t>(far.size());
  stats.messages += channel.messages();
  stats.bytes += channel.bytes();
  stats.work = static_cast<std::int64_t>(own_work());
  stats.imbalance = imbalance;
  stats.moved_bodies = std::exchange(moved_bodies, 0);
  stats.moved_bytes = std::exchange(moved_bytes, 0);
  return stats;
}

// All that may fail, before anything of the step counts.
void World::Implementation::commit(const tact::Report& found) {
  const std::int64_t before = channel.bytes();
  std::map<KeyPair, Sent> next_sent;
  const auto messages = channel.exchange([&](Outbox& outbox) { send_results(found, outbox, next_sent); });
  stats.result_bytes += channel.bytes() - before;
  const std::exception_ptr failure = Channel::failure_of([&] {
    sent = std::move(next_sent);
    ReportBuilder::clear(next_report);
    take_results(messages);
    build_report(found);
    count_work(found);
  });
  std::uint64_t sum = 0, most = 0;
  for (const std::uint64_t work : channel.gather(own_work(), failure)) {
    sum += work;
    most = std::max(most, work);
  }
  imbalance = sum == 0 ? 1.0 : static_cast<double>(most) * channel.size() / static_cast<double>(sum);
  ReportBuilder::stats(next_report) = finished_stats();
}

void World::Implementation::end_step() {
  ReportBuilder::swap(report, next_report);
  held.gone.clear();
  ended_waiting.clear();
  sends_all = false;
}

// The earliest impact of all is that of the first of the ranks, by time and keys.
void World::Implementation::finish_motion(const tact::MotionReport& found, Impacts wanted) {
  std::array<std::uint64_t, 3> own{std::bit_cast<std::uint64_t>(found.first_time()), 0, 0};
  for (const tact::Impact& impact : found.impacts()) {
    if (wanted != Impacts::first) break;
    const BodyPair bodies = named(impact.a, impact.b);
    own = {own[0], bodies.key_a, bodies.key_b};
  }
  std::array<std::uint64_t, 3> first = own;
  bool is_first = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto all = channel.gather(is_first ? own[i] : ~std::uint64_t{0});
    first[i] = *std::ranges::min_element(all);
    is_first = is_first && own[i] == first[i];
  }
  const std::span<const tact::Impact> impacts =
      wanted == Impacts::first && !is_first ? std::span<const tact::Impact>() : found.impacts();
  const std::int64_t before = channel.bytes();
  const auto messages = channel.exchange([&](Outbox& outbox) {
    for (const tact::Impact& impact : impacts) {
      const int to = guest_owner(impact.a, impact.b);
      if (to < 0) continue;
      put(outbox.to(to), named(impact.a, impact.b));
      outbox.to(to).put(impact.kind, impact.time, impact.stops);
      for (int k = 0; k < 3; ++k) outbox.to(to).put(impact.a_vertices[k], impact.b_vertices[k]);
    }
  });
  stats.result_bytes += channel.bytes() - before;
  channel.together([&] {
    ReportBuilder::clear(motion_report);
    std::vector<Impact>& list = ReportBuilder::impacts(motion_report);
    for (const tact::Impact& impact : impacts) list.push_back({named(impact.a, impact.b), impact});
    for (const Message& message : messages) {
      for (ByteReader reader(message.bytes); !reader.at_end();) {
        Impact& one = list.emplace_back();
        one.bodies = get_bodies(reader);
        one.impact.a = held.find(one.bodies.key_a), one.impact.b = held.find(one.bodies.key_b);
        one.impact.kind = reader.get<FeaturePair>();
        one.impact.time = reader.get<double>();
        one.impact.stops = reader.get<bool>();
        for (int k = 0; k < 3; ++k) {
          one.impact.a_vertices[k] = reader.get<int>();
          one.impact.b_vertices[k] = reader.get<int>();
        }
      }
    }
    std::ranges::stable_sort(list, {}, [](const Impact& impact) { return keys_of(impact.bodies); });
    ReportBuilder::first_time(motion_report) = std::bit_cast<double>(first[0]);
    ReportBuilder::stats(motion_report) = finished_stats();
  });
}

}  // namespace tact::mpi

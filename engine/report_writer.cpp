#include "engine/report_writer.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/touching.h"

namespace tact {

namespace {

// So many contacts are written by one thread: it takes less than to wake another.
constexpr std::size_t kFewContacts = 1024, kContactsAtATime = 64;

std::size_t contacts_at_a_time(std::size_t count) { return count <= kFewContacts ? kFewContacts : kContactsAtATime; }

template <class T>
void make_room(std::vector<T>& vector, std::size_t count, std::size_t spare) {
  if (vector.capacity() < count) vector.reserve(count + spare);
}

}  // namespace

void ReportWriter::Totals::add(const Contact& contact, std::int64_t times) {
  facet_pairs += times * static_cast<std::int64_t>(contact.facet_pairs().size());
  points += times * static_cast<std::int64_t>(contact.points().size());
  within_reach += times * static_cast<std::int64_t>(contact.within_reach().size());
  touching += contact.touching() ? times : 0;
  point_limits += contact.point_limit_reached ? times : 0;
}

void ReportWriter::Totals::add(const Totals& other) {
  facet_pairs += other.facet_pairs;
  points += other.points;
  within_reach += other.within_reach;
  touching += other.touching;
  point_limits += other.point_limits;
}

void ReportWriter::fill(Contact& contact, const PairRecord& record, const BodyKeys& keys) {
  contact = record.contact;
  contact.key_a_ = keys.of(record.a.index);
  contact.key_b_ = keys.of(record.b.index);
  contact.touching_ = record.touching;
  contact.points_ = record.points;
  contact.within_reach_ = record.within_reach;
  contact.facet_pairs_ = record.facet_pairs;
  if (record.patches != nullptr) contact.patches_ = record.patches->now.patches;
  if (record.curves != nullptr) contact.curves_ = record.curves->curves;
}

void ReportWriter::fill(Contact& contact, const SelfRecord& record, const BodyKeys& keys) {
  contact = Contact{};
  contact.a = contact.b = record.body;
  contact.key_a_ = contact.key_b_ = keys.of(record.body.index);
  contact.touching_ = record.touching;
  contact.facet_pairs_ = record.facet_pairs;
  contact.points_ = record.points;
  contact.within_reach_ = record.within_reach;
  contact.point_limit_reached = record.point_limit_reached;
  contact.patches_ = record.patches.now.patches;
  if (record.curves != nullptr) contact.curves_ = record.curves->curves;
}

template <class Record>
void ReportWriter::replace(Contact& contact, const Record& by, const BodyKeys& keys, Totals& totals) {
  totals.add(contact, -1);
  fill(contact, by, keys);
  totals.add(contact, 1);
}

void ReportWriter::add_thread_totals() {
  for (Totals& totals : thread_totals_) totals_.add(std::exchange(totals, {}));
}

void ReportWriter::copy_keys(const BodyKeys& keys) {
  if (keys_version_ == keys.version()) return;
  report_.keys_.assign(keys.all().begin(), keys.all().end());
  keys_version_ = keys.version();
}

void ReportWriter::restore(PairTable& table, const SelfStage& self, const Bodies& bodies) {
  copy_keys(bodies.keys());
  write_candidates(table, false);
  list_contacts(table, self, bodies.keys());
  report_.contacts_.resize(reported_.size());
  for (std::size_t i = 0; i < reported_.size(); ++i) {
    const auto& [place, of_self] = reported_[i];
    if (of_self == nullptr) table.place_in_report(place) = static_cast<std::uint32_t>(i);
    of_self == nullptr ? replace(report_.contacts_[i], table.record(place), bodies.keys(), totals_)
                       : replace(report_.contacts_[i], *of_self, bodies.keys(), totals_);
  }
}

void ReportWriter::forget() { *this = ReportWriter(); }

void ReportWriter::write(PairTable& table, const SelfStage& self, const Bodies& bodies, const Settings& settings) {
  thread_totals_.resize(settings.threads);
  copy_keys(bodies.keys());
  const bool same = table.same_contacts() && self.same_contacts();
  write_candidates(table, same);
  if (!same) {
    list_contacts(table, self, bodies.keys());
    carry_contacts(table, settings.threads);
  }
  write_contacts(table, bodies, settings);
  write_events(table, self, bodies);
  StepStats& stats = report_.stats_;
  stats.contacts = static_cast<std::int64_t>(report_.contacts_.size());
  stats.facet_pairs = totals_.facet_pairs;
  stats.points = totals_.points;
  stats.within_reach = totals_.within_reach;
  stats.point_limits_reached = totals_.point_limits;
  stats.touching_contacts = totals_.touching;
}

void ReportWriter::write_candidates(const PairTable& table, bool same) {
  const std::span<const CandidatePair> candidates = table.candidates();
  if (same) {  // from near to overlapping the contact stays, but not what the candidate says
    for (const MovedPair& pair : table.moved()) report_.candidate_pairs_[pair.place] = candidates[pair.place];
    return;
  }
  make_room(report_.candidate_pairs_, candidates.size(), candidates.size());
  report_.candidate_pairs_.assign(candidates.begin(), candidates.end());
}

// Candidates in contact and bodies in contact with themselves, both in order, merged.
void ReportWriter::list_contacts(const PairTable& table, const SelfStage& self, const BodyKeys& keys) {
  reported_.clear();
  has_self_ = !self.contacts().empty();
  auto next = self.contacts().begin();
  const auto add_self_before = [&](BodyId body) {
    for (; next != self.contacts().end() && keys.of((*next)->body.index) <= keys.of(body.index); ++next)
      reported_.push_back({.self = *next});
  };
  for (std::size_t i = 0; i < table.candidates().size(); ++i) {
    if (!table.in_contact(i)) continue;
    add_self_before(table.candidates()[i].a);
    reported_.push_back({.place = static_cast<std::uint32_t>(i)});
  }
  for (; next != self.contacts().end(); ++next) reported_.push_back({.self = *next});
}

// Puts each contact of the last report that the step did not look at where it belongs now; the others are empty.
void ReportWriter::carry_contacts(PairTable& table, int threads) {
  for (const MovedPair& pair : table.moved()) table.place_in_report(pair.place) = PairTable::kNowhere;
  std::swap(report_.contacts_, last_contacts_);
  const std::size_t count = reported_.size();
  make_room(report_.contacts_, count, count / 4);
  make_room(last_contacts_, count, count / 4);
  report_.contacts_.resize(count);
  base::parallel_for(count, contacts_at_a_time(count), threads, [&](std::size_t i, int thread) {
    Contact& contact = report_.contacts_[i];
    std::uint32_t place = PairTable::kNowhere;
    if (reported_[i].self == nullptr)
      place = std::exchange(table.place_in_report(reported_[i].place), static_cast<std::uint32_t>(i));
    if (place == PairTable::kNowhere) {
      contact = Contact{};
    } else {
      contact = last_contacts_[place];
      thread_totals_[thread].add(contact, 1);
    }
  });
  totals_ = {};
  add_thread_totals();
}

// Those that the step looked at.
void ReportWriter::write_contacts(PairTable& table, const Bodies& bodies, const Settings& settings) {
  const std::span<const MovedPair> moved = table.moved();
  base::parallel_for(moved.size(), contacts_at_a_time(moved.size()), settings.threads, [&](std::size_t i, int thread) {
    if (!table.in_contact(moved[i].place)) return;
    PairRecord& record = *moved[i].record;
    record.touching =
        any_meet(record) || is_touching(record.facet_pairs, record.points, bodies.rest(record.a.index, record.b.index));
    replace(report_.contacts_[table.place_in_report(moved[i].place)], record, bodies.keys(), thread_totals_[thread]);
  });
  add_thread_totals();
  for (std::size_t i = 0; i < reported_.size() && has_self_; ++i) {
    if (reported_[i].self != nullptr) replace(report_.contacts_[i], *reported_[i].self, bodies.keys(), totals_);
  }
}

// Only pairs that this step looked at can begin or cease to touch, and those that are no candidates any more.
void ReportWriter::write_events(const PairTable& table, const SelfStage& self, const Bodies& bodies) {
  const auto event_of = [](const PairRecord& record) { return ContactEvent{record.a, record.b}; };
  report_.began_.assign(self.began().begin(), self.began().end());
  report_.ended_.assign(table.gone().begin(), table.gone().end());
  report_.ended_.insert(report_.ended_.end(), self.ended().begin(), self.ended().end());
  for (const MovedPair& pair : table.moved()) {
    const bool touches = table.touches_now(pair);
    if (touches && !pair.touched) report_.began_.push_back(event_of(*pair.record));
    if (!touches && pair.touched) report_.ended_.push_back(event_of(*pair.record));
  }
  const auto order = [&](const ContactEvent& event) {
    return std::tuple(bodies.key(event.a), event.a, bodies.key(event.b), event.b);
  };
  std::ranges::sort(report_.began_, {}, order);
  std::ranges::sort(report_.ended_, {}, order);
}

}  // namespace tact

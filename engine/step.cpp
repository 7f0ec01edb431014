#include "engine/step.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "engine/patches.h"
#include "engine/step_statistics.h"
#include "narrowphase/mesh/prefetch.h"

namespace tact {

namespace {

using base::Timer;

// So many contacts are reported by one thread: it takes less than to wake another.
constexpr std::size_t kFewContacts = 1024, kContactsAtATime = 64;

// How many pairs ahead memory is asked for, and the cache lines of a record that pairs need which are apart.
constexpr std::size_t kBoxes = 2, kBody = 4, kRecord = 8, kRecordLines = 3;

ContactEvent event_of(const PairRecord& record) { return {record.a, record.b}; }

bool before(const ContactEvent& x, const ContactEvent& y) { return x.a < y.a || (x.a == y.a && x.b < y.b); }

}  // namespace

void Step::regroup(Bodies& bodies, int threads) {
  Timer timer;
  const std::vector<Bodies::Regrouped> regrouped = bodies.regroup(threads);
  regrouped_ = static_cast<std::int64_t>(regrouped.size());
  if (!forgotten_) table_.renumber(regrouped);
  regroup_ms_ = timer.lap();
}

const Report& Step::run(Bodies& bodies, const Settings& settings, double refresh_ms) {
  Timer timer(settings.outputs.trace ? 0.0 : base::TickCounter::tick_ms());  // a trace wants times, not durations alone
  const TraceEvent::Time begin = timer.start();
  if (forgotten_) start_afresh();
  if (bodies.changed().empty() && !all_) {
    keep_report();
    report_.stats_.refresh_ms = refresh_ms;
    report_.stats_.total_ms = refresh_ms + timer.lap();
    make_trace(begin, timer.start(), settings);
    return report_;
  }
  const StepStats last = report_.stats_;
  report_.stats_ = {};
  StepStats& stats = report_.stats_;
  stats.bodies = static_cast<std::int64_t>(bodies.count());
  stats.vertices = bodies.vertices();
  stats.regrouped_bodies = std::exchange(regrouped_, 0);
  stats.regroup_ms = std::exchange(regroup_ms_, 0.0);

  sweep_.update(bodies.boxes(), bodies.filters(), bodies.changed(), settings.threads);
  table_.update(sweep_, bodies, all_);
  stats.sweep_ms = timer.lap();
  narrow_phase(bodies, settings, timer);
  if (settings.outputs.points) points_.run(table_.moved(), bodies, settings, device_);
  self_.run(bodies, settings, all_, points_, device_);
  stats.narrow_phase_ms = stats.parting_ms + timer.lap();
  count_bodies_and_pairs(bodies);
  if (table_.same_contacts() && self_.same_contacts()) {
    update_report(last);
  } else {
    make_report(settings.threads);
  }
  for (const ThreadTally& tally : tallies_) add(stats, tally.stats);
  add_events();
  bodies.end_step();
  all_ = false;
  stats.report_ms = timer.lap();
  stats.refresh_ms = refresh_ms;
  stats.total_ms = refresh_ms + stats.sweep_ms + stats.narrow_phase_ms + stats.report_ms;
  make_trace(begin, timer.start(), settings);
  return report_;
}

void Step::make_trace(TraceEvent::Time begin, TraceEvent::Time end, const Settings& settings) {
  report_.trace_.clear();
  if (settings.outputs.trace) trace_.make(begin, end, report_.stats_, table_.moved(), large(), report_.trace_);
  trace_.forget_refreshes();
}

void Step::start_afresh() {
  sweep_ = {};
  table_ = {};
  large_.clear();
  large_count_ = 0;
  thread_work_.clear();
  last_contacts_ = {};
  points_ = {};
  self_ = {};
  report_ = {};
  all_ = true;
  forgotten_ = false;
}

// Nothing moved: the last answer stands, its events and its work do not.
void Step::keep_report() {
  table_.keep();
  large_count_ = 0;
  const StepStats last = report_.stats_;
  report_.stats_ = {};
  report_.stats_.bodies = last.bodies;
  report_.stats_.vertices = last.vertices;
  report_.stats_.candidate_pairs = last.candidate_pairs;
  report_.stats_.kept_pairs = last.candidate_pairs;
  report_.stats_.contacts = last.contacts;
  report_.stats_.facet_pairs = last.facet_pairs;
  report_.stats_.touching_contacts = last.touching_contacts;
  report_.began_.clear();
  report_.ended_.clear();
}

// Asks for the memory of pairs that are looked at soon: first the record, then the rest of it and the second body, then
// its boxes, and its vertices if the hulls overlapped. The first body of a pair is most often that of the last; where
// there are fewer pairs than bodies it is not. Of the records from `own_end` on, which another thread may write, only
// the bodies are read.
void Step::prefetch_pairs(const Bodies& bodies, std::size_t i, std::size_t own_end) const {
  const std::span<const MovedPair> moved = table_.moved();
  const auto lines = [](const PairRecord* record, std::size_t first, std::size_t last) {
    narrowphase::prefetch_lines(reinterpret_cast<const char*>(record) + 64 * first, 64 * (last - first));
  };
  const auto mesh = [&](BodyId id) -> const narrowphase::ClusteredMesh& { return bodies.in_slot(id.index).mesh; };
  if (i + kRecord < moved.size()) lines(moved[i + kRecord].record, 0, kRecordLines);
  if (i + kBody < moved.size()) {
    const PairRecord& record = *moved[i + kBody].record;
    narrowphase::prefetch_lines(&mesh(record.b), 1);
    if (i + kBody < own_end && record.hulls_overlap) lines(&record, kRecordLines, sizeof(PairRecord) / 64);
  }
  if (i + kBoxes < moved.size()) {
    const PairRecord& record = *moved[i + kBoxes].record;
    prefetch_boxes(mesh(record.b));
    if (i + kBoxes >= own_end || record.history.kind == PairHistory::Kind::none) return;
    if (record.hulls_overlap) prefetch_points(mesh(record.b));
    prefetch_position(mesh(record.a), record.history.hulls.a[0]);
    prefetch_position(mesh(record.b), record.history.hulls.b[0]);
  }
}

// The same for the first bodies.
void Step::prefetch_first_bodies(const Bodies& bodies, std::size_t i, std::size_t own_end) const {
  const std::span<const MovedPair> moved = table_.moved();
  const auto mesh = [&](std::size_t k) -> const narrowphase::ClusteredMesh& {
    return bodies.in_slot(moved[k].record->a.index).mesh;
  };
  if (i + kBody < moved.size()) narrowphase::prefetch_lines(&mesh(i + kBody), 1);
  if (i + kBoxes >= moved.size()) return;
  prefetch_boxes(mesh(i + kBoxes));
  if (i + kBoxes < own_end && moved[i + kBoxes].record->hulls_overlap) prefetch_points(mesh(i + kBoxes));
}

// Stages 3 to 6, all pairs in parallel, each into its own record; then the large ones, each on all threads.
void Step::narrow_phase(Bodies& bodies, const Settings& settings, Timer& timer) {
  table_.take_out_parted(bodies, settings.threads);
  report_.stats_.parting_ms = report_.stats_.hulls_ms = timer.lap();
  const std::span<MovedPair> moved = table_.moved();
  thread_work_.resize(static_cast<std::size_t>(settings.threads));
  tallies_.assign(static_cast<std::size_t>(settings.threads), {.timer = timer});
  large_count_ = 0;
  std::mutex mutex;
  const std::size_t grain = base::grain_of(moved.size(), settings.threads, 4, 64);
  const bool few_pairs = moved.size() < bodies.count(), asks_ahead = !bodies.stay_in_cache();
  base::parallel_for(moved.size(), grain, settings.threads, [&](std::size_t i, int thread) {
    const std::size_t own_end = settings.threads == 1 ? moved.size() : i - i % grain + grain;
    if (asks_ahead && few_pairs) prefetch_first_bodies(bodies, i, own_end);
    if (asks_ahead) prefetch_pairs(bodies, i, own_end);
    PairWork& work = thread_work_[static_cast<std::size_t>(thread)];
    work.asks_ahead = asks_ahead;
    ThreadTally& tally = tallies_[static_cast<std::size_t>(thread)];
    PairRecord& record = *moved[i].record;
    const Body &a = bodies.in_slot(record.a.index), &b = bodies.in_slot(record.b.index);
    if (!std::exchange(tally.begun, true)) tally.timer.lap();
    table_.begin(moved[i]);
    const bool confirms = find_direction_and_cull(record, a, b, bodies.reach(record.a.index, record.b.index), settings,
                                                  device_, work, tally.timer);
    record.counts.thread = thread;
    table_.end(moved[i]);
    if (confirms) table_.make_room(record);
    if (confirms && is_large(work, moved.size(), settings.threads)) {
      record.counts.in_ranges = true;
      const std::lock_guard lock(mutex);
      put_aside(work);
      return;
    }
    if (confirms) confirm(work, tally.timer);
    add_work(record, settings, tally.stats);
  });
  for (const auto& work : large()) {
    confirm_in_ranges(*work, thread_work_, settings.threads);
    add_work(*work->record, settings, tallies_[0].stats);
  }
  if (settings.outputs.patches && settings.accuracy != Accuracy::hulls) {
    base::parallel_for(moved.size(), 4, settings.threads, [&](std::size_t i) {
      if (!table_.touches_now(moved[i])) return;
      PairRecord& record = *moved[i].record;
      record.patches = find_patches(bodies.in_slot(record.a.index), bodies.in_slot(record.b.index), record);
    });
  }
}

// Takes the work on a large pair and gives other memory for it.
void Step::put_aside(PairWork& work) {
  if (large_.size() == large_count_) large_.push_back(std::make_unique<PairWork>());
  PairWork& large = *large_[large_count_++];
  std::swap(work, large);
  large.input.kept_a = &large.kept_a;
  large.input.kept_b = &large.kept_b;
}

void Step::count_bodies_and_pairs(const Bodies& bodies) {
  StepStats& stats = report_.stats_;
  stats.moved_bodies = static_cast<std::int64_t>(std::count_if(bodies.changed().begin(), bodies.changed().end(),
                                                               [&](std::uint32_t slot) { return bodies.used(slot); }));
  stats.moved_vertices = bodies.moved_vertices();
  stats.excluded_pairs = static_cast<std::int64_t>(sweep_.excluded());
  stats.candidate_pairs = static_cast<std::int64_t>(table_.candidates().size());
  stats.parted_pairs = static_cast<std::int64_t>(table_.parted());
  stats.kept_pairs = static_cast<std::int64_t>(table_.candidates().size() - table_.moved().size() - table_.parted());
}

void Step::make_report(int threads) {
  const std::span<const CandidatePair> candidates = table_.candidates();
  if (report_.candidate_pairs_.capacity() < candidates.size()) report_.candidate_pairs_.reserve(2 * candidates.size());
  report_.candidate_pairs_.assign(candidates.begin(), candidates.end());
  list_contacts();
  // Contacts of pairs that were not looked at stand as they are: their records, far apart in memory, are not read.
  for (const MovedPair& pair : table_.moved()) table_.place_in_report(pair.place) = PairTable::kNowhere;
  std::swap(report_.contacts_, last_contacts_);
  for (std::vector<Contact>* contacts : {&report_.contacts_, &last_contacts_}) {
    if (contacts->capacity() < reported_.size()) contacts->reserve(reported_.size() + reported_.size() / 4);
  }
  report_.contacts_.resize(reported_.size());
  report_.stats_.contacts = static_cast<std::int64_t>(reported_.size());
  const std::size_t at_a_time = reported_.size() <= kFewContacts ? kFewContacts : kContactsAtATime;
  base::parallel_for(reported_.size(), at_a_time, threads, [&](std::size_t i, int thread) {
    Contact& contact = report_.contacts_[i];
    if (reported_[i].self != nullptr) {
      fill(contact, *reported_[i].self);
    } else {
      std::uint32_t& place = table_.place_in_report(reported_[i].place);
      if (place == PairTable::kNowhere) {
        fill(contact, table_.record(reported_[i].place));
      } else {
        contact = last_contacts_[place];
      }
      place = static_cast<std::uint32_t>(i);
    }
    StepStats& stats = tallies_[static_cast<std::size_t>(thread)].stats;
    stats.facet_pairs += static_cast<std::int64_t>(contact.facet_pairs().size());
    stats.touching_contacts += contact.touching() ? 1 : 0;
  });
}

// Candidates in contact and bodies in contact with themselves, both in order, merged.
void Step::list_contacts() {
  reported_.clear();
  auto self = self_.contacts().begin();
  const auto add_self_before = [&](BodyId body) {
    for (; self != self_.contacts().end() && !(body < (*self)->body); ++self) reported_.push_back({.self = *self});
  };
  for (std::size_t i = 0; i < table_.candidates().size(); ++i) {
    if (!table_.in_contact(i)) continue;
    add_self_before(table_.candidates()[i].a);
    reported_.push_back({.place = static_cast<std::uint32_t>(i)});
  }
  for (; self != self_.contacts().end(); ++self) reported_.push_back({.self = *self});
}

void Step::fill(Contact& contact, const SelfRecord& record) {
  contact = Contact{};
  contact.a = contact.b = record.body;
  contact.facet_pairs_ = record.facet_pairs;
  contact.points_ = record.points;
}

void Step::fill(Contact& contact, const PairRecord& record) {
  contact = record.contact;
  contact.points_ = record.points;
  contact.facet_pairs_ = record.facet_pairs;
  contact.patches_ = record.patches;
}

// The contacts are those of the last step, only what this one looked at is new.
void Step::update_report(const StepStats& last) {
  StepStats& stats = report_.stats_;
  stats.contacts = last.contacts;
  stats.facet_pairs = last.facet_pairs;
  stats.touching_contacts = last.touching_contacts;
  const auto add = [&](const Contact& contact, std::int64_t times) {
    stats.facet_pairs += times * static_cast<std::int64_t>(contact.facet_pairs().size());
    stats.touching_contacts += contact.touching() ? times : 0;
  };
  for (const MovedPair& pair : table_.moved()) {
    // From near to overlapping the contact stays, but not what the candidate says.
    report_.candidate_pairs_[pair.place] = table_.candidates()[pair.place];
    if (!table_.in_contact(pair.place)) continue;
    Contact& contact = report_.contacts_[table_.place_in_report(pair.place)];
    add(contact, -1);
    fill(contact, *pair.record);
    add(contact, 1);
  }
  for (std::size_t i = 0; i < reported_.size() && !self_.contacts().empty(); ++i) {
    if (reported_[i].self == nullptr) continue;
    Contact& contact = report_.contacts_[i];
    add(contact, -1);
    fill(contact, *reported_[i].self);
    add(contact, 1);
  }
}

// Only pairs that this step looked at can begin or cease to touch, and those that are no candidates any more.
void Step::add_events() {
  report_.began_.clear();
  report_.ended_.assign(table_.gone().begin(), table_.gone().end());
  for (const MovedPair& pair : table_.moved()) {
    const bool touches = table_.touches_now(pair);
    if (touches && !pair.touched) report_.began_.push_back(event_of(*pair.record));
    if (!touches && pair.touched) report_.ended_.push_back(event_of(*pair.record));
  }
  std::sort(report_.ended_.begin(), report_.ended_.end(), before);
}

}  // namespace tact

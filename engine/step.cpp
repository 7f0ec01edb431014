#include "engine/step.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "engine/patches.h"

namespace tact {

namespace {

using base::Timer;

constexpr std::size_t kLargestRoom = 512;  // facet pairs, 4 kB

ContactEvent event_of(const PairRecord& record) { return {record.a, record.b}; }

bool before(const ContactEvent& x, const ContactEvent& y) { return x.a < y.a || (x.a == y.a && x.b < y.b); }

bool names(const Bodies& bodies, BodyId id) { return bodies.in_slot(id.index).id == id; }

bool touches(const PairRecord& record) { return record.hulls_overlap && !record.facet_pairs.empty(); }

}  // namespace

const Report& Step::run(Bodies& bodies, const Settings& settings, double refresh_ms) {
  Timer total;
  Timer timer = total;
  if (forgotten_) start_afresh();
  if (bodies.changed().empty() && !all_) {
    keep_report();
    finish(total, settings, refresh_ms);
    return report_;
  }
  const StepStats last = report_.stats_;
  report_.stats_ = {};
  StepStats& stats = report_.stats_;
  stats.bodies = static_cast<std::int64_t>(bodies.count());
  stats.vertices = bodies.vertices();

  sweep_.update(bodies.boxes(), bodies.filters(), bodies.changed(), settings.threads);
  note_touches();
  const bool same_pairs = !all_ && !bodies.removed_any() && !sweep_.pairs_changed();
  if (same_pairs) {
    select_moved(bodies);
  } else {
    match_records(bodies);
  }
  stats.sweep_ms = timer.lap();
  narrow_phase(bodies, settings);
  stats.narrow_phase_ms = timer.lap();
  count_work(bodies, settings);
  if (same_pairs && same_contacts()) {
    update_report(last);
  } else {
    make_report();
  }
  add_events();
  stats.report_ms = timer.lap();
  bodies.end_step();
  all_ = false;
  finish(total, settings, refresh_ms);
  return report_;
}

void Step::finish(Timer& total, const Settings& settings, double refresh_ms) {
  const auto begin = total.start();
  report_.stats_.refresh_ms = refresh_ms;
  report_.stats_.total_ms = refresh_ms + total.lap();
  report_.trace_.clear();
  if (settings.outputs.trace) trace_.make(begin, total.start(), report_.stats_, moved_, large(), report_.trace_);
  trace_.forget_refreshes();
}

void Step::start_afresh() {
  sweep_ = {};
  records_.clear();
  pairs_.clear();
  previous_.clear();
  moved_.clear();
  free_.clear();
  pool_.clear();
  large_.clear();
  large_count_ = 0;
  thread_work_.clear();
  report_ = {};
  all_ = true;
  forgotten_ = false;
}

// Nothing moved: the last answer stands, its events and its work do not.
void Step::keep_report() {
  note_touches();
  moved_.clear();
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

// What the last step looked at is the last step's now. Other records are as they were.
void Step::note_touches() {
  for (PairRecord* record : moved_) record->touched = touches(*record);
}

// The pairs are those of the last step: so are the records.
void Step::select_moved(const Bodies& bodies) {
  gone_.clear();
  moved_.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (bodies.moved(pairs_[i].a) || bodies.moved(pairs_[i].b)) moved_.push_back(records_[i]);
  }
}

// Both lists of pairs are sorted: a pair that stays keeps its record, unless a body of it was replaced by another. What
// stays is not looked at, as memory is what costs where little moves.
void Step::match_records(const Bodies& bodies) {
  gone_.clear();
  std::swap(previous_, records_);
  records_.clear();
  moved_.clear();
  std::size_t old = 0;
  for (const broadphase::IndexPair& pair : sweep_.pairs()) {
    while (old < pairs_.size() && pairs_[old] < pair) retire(*previous_[old++]);
    PairRecord* record = old < pairs_.size() && pairs_[old] == pair ? previous_[old++] : nullptr;
    if (record != nullptr && bodies.removed_any() && !(names(bodies, record->a) && names(bodies, record->b))) {
      retire(*std::exchange(record, nullptr));
    }
    if (record == nullptr) record = &new_record(bodies.in_slot(pair.a).id, bodies.in_slot(pair.b).id);
    records_.push_back(record);
    if (all_ || bodies.moved(pair.a) || bodies.moved(pair.b)) moved_.push_back(record);
  }
  while (old < pairs_.size()) retire(*previous_[old++]);
  previous_.clear();
  pairs_.assign(sweep_.pairs().begin(), sweep_.pairs().end());
}

PairRecord& Step::new_record(BodyId a, BodyId b) {
  if (free_.empty()) {
    free_.reserve(pool_.size() + 1);  // so that retire() cannot fail
    pool_.push_back(std::make_unique<PairRecord>());
    free_.push_back(pool_.back().get());
  }
  PairRecord& record = *free_.back();
  free_.pop_back();
  record.a = a;
  record.b = b;
  record.history = {};
  record.hulls_overlap = false;
  record.touched = false;
  record.facet_pairs.clear();
  record.facet_pairs.reserve(room_);
  record.patches.clear();
  return record;
}

void Step::retire(PairRecord& record) {
  if (touches(record)) gone_.push_back(event_of(record));
  // Records are given out again in any order: each has room for what the largest held.
  room_ = std::min(std::max(room_, record.facet_pairs.capacity()), kLargestRoom);
  free_.push_back(&record);
}

// Asks for the memory of pairs that are looked at soon: first the record, then the rest of it and the second body, then
// its boxes and the vertices that the last step ended at. The first body of a pair is most often that of the last. Of
// the records from `own_end` on, which another thread may write, only the bodies are read.
void Step::prefetch_pairs(const Bodies& bodies, std::size_t i, std::size_t own_end) const {
  constexpr std::size_t kBoxes = 2, kBody = 4, kRecord = 8, kRecordLines = 3;  // how many pairs before, cache lines
  const auto lines = [](const PairRecord* record, std::size_t first, std::size_t last) {
    narrowphase::prefetch_lines(reinterpret_cast<const char*>(record) + 64 * first, 64 * (last - first));
  };
  const auto mesh = [&](BodyId id) -> const narrowphase::ClusteredMesh& { return bodies.in_slot(id.index).mesh; };
  if (i + kRecord < moved_.size()) lines(moved_[i + kRecord], 0, kRecordLines);
  if (i + kBody < moved_.size()) {
    const PairRecord& record = *moved_[i + kBody];
    narrowphase::prefetch_lines(&mesh(record.b), 1);
    if (i + kBody < own_end && record.hulls_overlap) lines(&record, kRecordLines, sizeof(PairRecord) / 64);
  }
  if (i + kBoxes < moved_.size()) {
    const PairRecord& record = *moved_[i + kBoxes];
    mesh(record.b).prefetch_boxes();
    if (i + kBoxes >= own_end || record.history.kind == PairHistory::Kind::none) return;
    mesh(record.a).prefetch_position(record.history.hulls.a[0]);
    mesh(record.b).prefetch_position(record.history.hulls.b[0]);
  }
}

// Stages 3 to 6, all pairs in parallel, each into its own record; then the large ones, each on all threads.
void Step::narrow_phase(const Bodies& bodies, const Settings& settings) {
  thread_work_.resize(static_cast<std::size_t>(settings.threads));
  large_count_ = 0;
  std::mutex mutex;
  const std::size_t grain = base::grain_of(moved_.size(), settings.threads, 4, 64);
  base::parallel_for(moved_.size(), grain, settings.threads, [&](std::size_t i, int thread) {
    prefetch_pairs(bodies, i, settings.threads == 1 ? moved_.size() : i - i % grain + grain);
    PairWork& work = thread_work_[static_cast<std::size_t>(thread)];
    PairRecord& record = *moved_[i];
    const Body &a = bodies.in_slot(record.a.index), &b = bodies.in_slot(record.b.index);
    const bool confirms = find_direction_and_cull(record, a, b, settings, device_, work);
    record.counts.thread = thread;
    if (!confirms) return;
    if (!is_large(work, moved_.size(), settings.threads)) {
      confirm(work);
      return;
    }
    record.counts.in_ranges = true;
    const std::lock_guard lock(mutex);
    put_aside(work);
  });
  for (const auto& work : large()) confirm_in_ranges(*work, thread_work_, settings.threads);
  if (settings.outputs.patches && settings.accuracy != Accuracy::hulls) {
    base::parallel_for(moved_.size(), 4, settings.threads, [&](std::size_t i) {
      PairRecord& record = *moved_[i];
      if (!touches(record)) return;
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

void Step::count_work(const Bodies& bodies, const Settings& settings) {
  StepStats& stats = report_.stats_;
  stats.moved_bodies = static_cast<std::int64_t>(std::count_if(bodies.changed().begin(), bodies.changed().end(),
                                                               [&](std::uint32_t slot) { return bodies.used(slot); }));
  stats.moved_vertices = bodies.moved_vertices();
  stats.excluded_pairs = static_cast<std::int64_t>(sweep_.excluded());
  stats.candidate_pairs = static_cast<std::int64_t>(records_.size());
  stats.kept_pairs = static_cast<std::int64_t>(records_.size() - moved_.size());
  for (const PairRecord* record : moved_) add_work(*record, settings);
}

void Step::make_report() {
  StepStats& stats = report_.stats_;
  report_.contacts_.clear();
  report_.candidate_pairs_.clear();
  for (PairRecord* record : records_) {
    record->candidate = report_.candidate_pairs_.size();
    report_.candidate_pairs_.push_back({record->a, record->b, record->hulls_overlap});
    if (!record->hulls_overlap) continue;
    record->reported = report_.contacts_.size();
    fill(report_.contacts_.emplace_back(), *record);
    stats.facet_pairs += static_cast<std::int64_t>(record->facet_pairs.size());
    stats.touching_contacts += touches(*record) ? 1 : 0;
  }
  stats.contacts = static_cast<std::int64_t>(report_.contacts_.size());
}

void Step::fill(Contact& contact, const PairRecord& record) {
  contact = record.contact;
  contact.facet_pairs_ = record.facet_pairs;
  contact.patches_ = record.patches;
}

// Do the pairs that this step looked at overlap where they did in the last?
bool Step::same_contacts() const {
  return std::all_of(moved_.begin(), moved_.end(), [&](const PairRecord* record) {
    return report_.candidate_pairs_[record->candidate].hulls_overlap == record->hulls_overlap;
  });
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
  for (const PairRecord* record : moved_) {
    if (!record->hulls_overlap) continue;
    Contact& contact = report_.contacts_[record->reported];
    add(contact, -1);
    fill(contact, *record);
    add(contact, 1);
  }
}

// Only pairs that this step looked at can begin or cease to touch, and those that are no candidates any more.
void Step::add_events() {
  report_.began_.clear();
  report_.ended_ = gone_;
  for (const PairRecord* record : moved_) {
    if (touches(*record) && !record->touched) report_.began_.push_back(event_of(*record));
    if (!touches(*record) && record->touched) report_.ended_.push_back(event_of(*record));
  }
  std::sort(report_.ended_.begin(), report_.ended_.end(), before);
}

// Adds what the pair cost in this step.
void Step::add_work(const PairRecord& record, const Settings& settings) {
  StepStats& stats = report_.stats_;
  const PairCounts& counts = record.counts;
  stats.gjk_iterations += counts.gjk_iterations;
  stats.hulls_ms += counts.hulls_ms;
  stats.gjk_ms += counts.still_separated || counts.still_overlapping ? 0.0 : counts.hulls_ms;
  stats.still_overlapping_pairs += counts.still_overlapping ? 1 : 0;
  stats.direction_ms += counts.direction_ms;
  stats.cull_ms += counts.cull_ms;
  stats.confirm_ms += counts.confirm_ms;
  if (!record.hulls_overlap) {
    stats.limits_reached += counts.limit_reached ? 1 : 0;
    (counts.still_separated ? stats.still_separated_pairs : stats.separated_pairs) += 1;
    return;
  }
  const Contact& contact = record.contact;
  stats.limits_reached += contact.limit_reached ? 1 : 0;
  stats.direction_iterations += contact.iterations;
  stats.carried_directions += contact.source == DirectionSource::carried ? 1 : 0;
  stats.fresh_directions += contact.source == DirectionSource::fresh ? 1 : 0;
  stats.smallest_directions += contact.source == DirectionSource::smallest ? 1 : 0;
  if (settings.accuracy == Accuracy::hulls) return;
  const std::int64_t kept = contact.kept_facets_a + contact.kept_facets_b;
  const FacetCounts& facet_counts = record.facet_counts;
  stats.clusters += facet_counts.clusters;
  stats.clusters_outside_box += facet_counts.clusters_outside_box;
  stats.clusters_outside_slab += facet_counts.clusters_outside_slab;
  stats.opened_clusters += facet_counts.opened_clusters;
  stats.opened_facets += facet_counts.opened_facets;
  stats.facets += facet_counts.facets;
  stats.kept_facets += kept;
  stats.facets_facing_away += facet_counts.facing_away;
  stats.facets_outside_zone += facet_counts.outside_zone;
  // Whole clusters fall to criterion 2.
  stats.facets_outside_slab += facet_counts.facets - kept - facet_counts.facing_away - facet_counts.outside_zone;
  stats.cluster_pairs += facet_counts.cluster_pairs;
  stats.tree_pairs += facet_counts.used_trees ? 1 : 0;
  stats.facet_box_pairs += facet_counts.facet_box_pairs;
  stats.triangle_tests += facet_counts.triangle_tests;
  stats.exact_predicates += facet_counts.exact_predicates;
}

}  // namespace tact

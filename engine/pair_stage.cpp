#include "engine/pair_stage.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/pair/cull.h"
#include "engine/pair/find_direction.h"
#include "engine/pair/prefetch.h"
#include "engine/pair/separate_by_kdop.h"
#include "engine/pair/test_hulls.h"

namespace tact {

namespace {

constexpr std::size_t kFewestAtATime = 4, kMostAtATime = 64;  // pairs

// Pairs that a thread takes at a time. Few pairs of large bodies are taken one by one.
std::size_t grain_for(std::span<const MovedPair> moved, const Bodies& bodies, const Settings& settings) {
  const base::Tuning& tuning = bodies.tuning();
  if (settings.threads > 1 && moved.size() > 1 && is_few(moved.size(), settings.threads, tuning)) {
    std::size_t facets = 0;
    for (const MovedPair& pair : moved) {
      const auto facets_of = [&](BodyId id) {
        return static_cast<std::size_t>(bodies.in_slot(id.index).mesh.facet_count());
      };
      facets += std::min(facets_of(pair.record->a), facets_of(pair.record->b));
    }
    if (facets >= tuning.worth_threads) return 1;
  }
  return base::grain_of(moved.size(), settings.threads, kFewestAtATime, kMostAtATime);
}

// What it found in the last step, points are remembered.
void clear_answers(PairRecord& record) {
  record.facet_pairs.clear();
  std::swap(record.points, record.last_points);
  record.points.clear();
  record.touching = false;
}

}  // namespace

void PairStage::run(PairTable& table, Bodies& bodies, const Settings& settings, narrowphase::EmbreeDevice& device,
                    const base::Timer& timer) {
  base::Timer own_timer = timer;
  own_timer.lap();
  separate_by_kdop(table, bodies, settings.threads);
  kdop_ms_ = own_timer.lap();

  const auto threads = static_cast<std::size_t>(settings.threads);
  work_.resize(threads);
  for (PairWork& work : work_) {
    work.counts = {};
    work.keep_travel.clear();
    work.prefetches = !bodies.stay_in_cache();
  }
  clocks_.assign(threads, {.timer = own_timer});
  large_count_ = 0;
  const std::span<MovedPair> moved = table.moved();
  const std::size_t grain = grain_for(moved, bodies, settings);
  const PairPrefetch prefetch(bodies, moved, grain, settings.threads);
  const bool few = is_few(moved.size(), settings.threads, bodies.tuning());  // many pairs are not counted one by one
  std::atomic<std::size_t> left = few ? moved.size() : 0, gone = 0;
  const auto look_at_next = [&](std::size_t i, int thread) {
    if (prefetch.pays()) prefetch.prefetch_after(i);
    PairRecord& record = *moved[i].record;
    moved[i].touched = record.touching;
    const PairInput pair(bodies, record.a, record.b, settings);
    look_at(pair, record, table, device, thread);
    table.note_result(moved[i]);
    if (few) --left;
  };
  // Ranges of large pairs. A thread that finds none goes; when no pairs are left, the other ranges are for all threads.
  const auto help_with_large = [&](int thread) {
    while ((left > 0 || gone == 0) && confirm_next_range(bodies.tuning(), thread)) {
    }
    ++gone;
  };
  base::parallel_for(moved.size(), grain, settings.threads, look_at_next, help_with_large);
  if (large_count_ > 0) confirm_large_pairs(settings.threads, bodies.tuning());
  for (const PairWork& work : work_) {
    for (const BodyId body : work.keep_travel) bodies.keep_travel(body.index);
  }
}

// One pair through stages 3 to 6. A large one is put aside before the last.
void PairStage::look_at(const PairInput& pair, PairRecord& record, PairTable& table, narrowphase::EmbreeDevice& device,
                        int thread) {
  PairWork& work = work_[thread];
  ThreadClock& clock = clocks_[thread];
  if (!std::exchange(clock.begun, true)) clock.timer.lap();
  const auto note = [&](float PairTimes::*of_pair, double PairCounts::*sum) {
    const double ms = clock.timer.lap();
    record.times.*of_pair = static_cast<float>(ms);
    work.counts.*sum += ms;
    return ms;
  };
  record.times = {.begin = clock.timer.start(), .thread = thread};
  record.was_in_contact = in_contact(record);
  if (record.was_in_contact) clear_answers(record);

  const HullTest hulls = test_hulls(pair, record, work);
  const double hulls_ms = note(&PairTimes::hulls_ms, &PairCounts::hulls_ms);
  if (hulls.took_gjk) work.counts.gjk_ms += hulls_ms;
  if (!hulls.overlap) return;

  const narrowphase::Slab slab = find_direction(pair, hulls, record, work);
  note(&PairTimes::direction_ms, &PairCounts::direction_ms);
  if (pair.settings.accuracy == Accuracy::hulls) return;

  cull(pair, slab, record, device, work);
  note(&PairTimes::cull_ms, &PairCounts::cull_ms);
  if (work.culled.cluster_pairs.empty()) return;

  table.make_room(record);
  if (is_large(work.culled, table.moved().size(), pair.settings.threads, pair.tuning)) {
    record.times.in_ranges = true;
    put_aside(work.culled, pair.settings.threads, pair.tuning);
    return;
  }
  confirm(pair.tuning, work);
  note(&PairTimes::confirm_ms, &PairCounts::confirm_ms);
}

// Takes a large pair and gives other memory for it.
void PairStage::put_aside(CulledPair& culled, int threads, const base::Tuning& tuning) {
  const std::lock_guard lock(large_mutex_);
  if (large_.size() == large_count_) large_.push_back(std::make_unique<LargePair>());
  LargePair& large = *large_[large_count_];
  std::swap(culled, large.culled);
  large.cut(threads, tuning);
  ++large_count_;
}

// Returns whether there was a range that no thread had taken. Threads begin at either end: what a thread refitted is in
// its cache.
bool PairStage::confirm_next_range(const base::Tuning& tuning, int thread) {
  LargePair* pair = nullptr;
  std::size_t range = 0;
  {
    const std::lock_guard lock(large_mutex_);
    const auto next = std::ranges::find_if(large(), [](const auto& p) { return p->next_range < p->end_range; });
    if (next == large().end()) return false;
    pair = next->get();
    range = thread % 2 == 0 ? pair->next_range++ : --pair->end_range;
  }
  confirm_range(*pair, range, tuning, thread, work_[thread]);
  return true;
}

// What is left of them when all pairs have been looked at.
void PairStage::confirm_large_pairs(int threads, const base::Tuning& tuning) {
  large_begin_ = base::Timer::Clock::now();
  left_ranges_.clear();
  std::size_t all = 0;
  for (const auto& pair : large()) all += pair->range_count;
  left_ranges_.reserve(all);  // how many are left is not the same in every step
  for (const auto& pair : large()) {
    for (; pair->next_range < pair->end_range; ++pair->next_range)
      left_ranges_.push_back({pair.get(), pair->next_range});
  }
  base::parallel_for(left_ranges_.size(), 1, threads, [&](std::size_t i, int thread) {
    confirm_range(*left_ranges_[i].pair, left_ranges_[i].range, tuning, thread, work_[thread]);
  });
  const int threads_of_pair = large_count_ > 1 ? 1 : threads;
  base::parallel_for(large_count_, 1, threads, [&](std::size_t i, int thread) {
    gather_ranges(*large_[i], tuning, threads_of_pair, work_[thread]);
  });
}

void PairStage::forget() {
  large_count_ = 0;
  large_.clear();
  work_.clear();
}

PairCounts PairStage::counts() const {
  PairCounts sum;
  for (const PairWork& work : work_) sum += work.counts;
  return sum;
}

}  // namespace tact

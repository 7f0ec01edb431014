#include "engine/pair_stage.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/pair/cull.h"
#include "engine/pair/find_direction.h"
#include "engine/pair/prefetch.h"
#include "engine/pair/separate_by_kdop.h"
#include "engine/pair/test_hulls.h"

namespace tact {

namespace {

// Drops what the last step found; its points become the last ones.
void clear_answers(PairRecord& record) {
  record.facet_pairs.clear();
  record.bare_pairs.clear();
  if (!std::exchange(record.is_renumbered, false)) std::swap(record.points, record.last_points);
  record.points.clear();
  record.within_reach.clear();
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
  large_.begin();
  const std::span<MovedPair> moved = table.moved();
  const std::size_t grain = items_at_a_time(moved.size(), settings.threads, bodies.tuning(), [&](std::size_t i) {
    const PairRecord& record = *moved[i].record;
    return std::min(bodies.in_slot(record.a.index).mesh.facet_count(),
                    bodies.in_slot(record.b.index).mesh.facet_count());
  });
  const PairPrefetch prefetch(bodies, moved, grain, settings.threads);
  const auto look_at_next = [&](std::size_t i, int thread) {
    if (prefetch.pays()) prefetch.prefetch_after(i);
    PairRecord& record = *moved[i].record;
    moved[i].touched = record.touching;
    if (const BodyAndPlane pair = body_and_plane(bodies, record.a.index, record.b.index)) {
      look_at(pair, bodies.reach(record.a.index, record.b.index), settings, record, thread);
    } else {
      look_at(PairTask(bodies, record, settings, work_[thread]), table, device, thread);
    }
    table.note_result(moved[i]);
  };
  const auto search = [&](const LargePairs::Shared& pair, LargePairs::Range& range, int thread) {
    confirm_range(pair.item, range, bodies.tuning(), thread, work_[thread]);
  };
  const bool few = is_few(moved.size(), settings.threads, bodies.tuning());
  large_.prepare(moved.size(), grain, settings.threads, few, look_at_next, search);
  large_begin_ = base::Timer::Clock::now();
  large_.search(settings.threads, search);
  large_.gather(settings.threads, [&](LargePairs::Shared& pair, int thread, int threads_of_pair) {
    gather_ranges(large_, pair, bodies.tuning(), threads_of_pair, work_[thread]);
  });
  for (const PairWork& work : work_) {
    for (const BodyId body : work.keep_travel) bodies.keep_travel(body.index);
  }
}

void PairStage::begin(PairRecord& record, int thread) {
  ThreadClock& clock = clocks_[thread];
  if (!std::exchange(clock.begun, true)) clock.timer.lap();
  record.times = {.begin = clock.timer.start(), .thread = thread};
  record.was_in_contact = in_contact(record);
  if (record.was_in_contact) clear_answers(record);
}

double PairStage::note(PairRecord& record, float PairTimes::*of_pair, double PairCounts::*sum, int thread) {
  const double ms = clocks_[thread].timer.lap();
  record.times.*of_pair = static_cast<float>(ms);
  work_[thread].counts.*sum += ms;
  return ms;
}

// A body and a plane.
void PairStage::look_at(const BodyAndPlane& pair, double reach, const Settings& settings, PairRecord& record,
                        int thread) {
  begin(record, thread);
  look_at_plane(pair, reach, settings, record, work_[thread].chosen, work_[thread].counts);
  note(record, &PairTimes::hulls_ms, &PairCounts::hulls_ms, thread);
}

// One pair through stages 3 to 6. A large one is put aside before the last.
void PairStage::look_at(const PairTask& pair, PairTable& table, narrowphase::EmbreeDevice& device, int thread) {
  PairRecord& record = pair.record;
  PairWork& work = pair.work;
  const auto note = [&](float PairTimes::*of_pair, double PairCounts::*sum) {
    return this->note(record, of_pair, sum, thread);
  };
  begin(record, thread);
  const HullTest hulls = test_hulls(pair);
  const double hulls_ms = note(&PairTimes::hulls_ms, &PairCounts::hulls_ms);
  if (hulls.took_gjk) work.counts.gjk_ms += hulls_ms;
  if (!hulls.overlap) return;

  const narrowphase::Slab slab = find_direction(pair, hulls);
  note(&PairTimes::direction_ms, &PairCounts::direction_ms);
  if (pair.settings.accuracy == Accuracy::hulls) return;

  cull(pair, slab, device);
  note(&PairTimes::cull_ms, &PairCounts::cull_ms);
  if (work.culled.cluster_pairs.empty()) return;

  table.make_room(record);
  const int threads = pair.settings.threads;
  const std::span<const narrowphase::ClusterPair> pairs = work.culled.cluster_pairs;
  if (is_large(kConfirmCost * pairs.size(), table.moved().size(), threads, pair.tuning)) {
    record.times.in_ranges = true;
    large_.put_aside(work.culled, pairs, count_of_ranges(kConfirmCost * pairs.size(), threads, pair.tuning));
    return;
  }
  confirm(pair.tuning, work);
  note(&PairTimes::confirm_ms, &PairCounts::confirm_ms);
}

PairCounts PairStage::counts() const {
  PairCounts sum;
  for (const PairWork& work : work_) sum += work.counts;
  return sum;
}

}  // namespace tact

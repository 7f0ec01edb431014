#include "engine/step_trace.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "engine/step_statistics.h"

namespace tact {

namespace {

using Kind = TraceEvent::Kind;
using Time = TraceEvent::Time;

// Pairs that take less are joined to one event, so that a trace grows with time rather than with pairs.
constexpr Time::duration kLongPair = std::chrono::microseconds(20);
constexpr std::size_t kEventsOfStep = 4 + std::size(kStageTimes),
                      kEventsOfPair = 5;  // at most, refreshes and ranges apart

Time::duration duration_of(double ms) {
  return std::chrono::round<Time::duration>(std::chrono::duration<double, std::milli>(ms));
}

// What one thread took for all stages of the pair; a large pair's stage 6 comes later.
Time::duration pair_duration(const PairTimes& times) {
  return duration_of(times.hulls_ms) + duration_of(times.direction_ms) + duration_of(times.cull_ms) +
         (times.in_ranges ? Time::duration(0) : duration_of(times.confirm_ms));
}

std::int64_t facet_pairs_of(const PairRecord& record) { return static_cast<std::int64_t>(record.facet_pairs.size()); }

// Durations are rounded: none ends after `latest`, when the thread went on to the next pair.
void add_pair(const PairRecord& record, Time latest, std::vector<TraceEvent>& events) {
  const PairTimes& times = record.times;
  const Time end = std::min(times.begin + pair_duration(times), latest);
  events.push_back({Kind::pair, times.thread, times.begin, end, record.a, record.b, facet_pairs_of(record)});
  Time begin = times.begin;
  for (const auto& [kind, ms] : {std::pair{Kind::hulls, times.hulls_ms},
                                 {Kind::direction, times.direction_ms},
                                 {Kind::cull, times.cull_ms},
                                 {Kind::confirm, times.confirm_ms}}) {
    if (ms == 0.0 || (kind == Kind::confirm && times.in_ranges)) continue;
    const Time stage_end = std::min(begin + duration_of(ms), latest);
    const std::int64_t count = kind == Kind::confirm ? facet_pairs_of(record) : 0;
    events.push_back({kind, times.thread, begin, stage_end, record.a, record.b, count});
    begin = stage_end;
  }
}

// Stage 6 of all large pairs, on the thread that called, and the ranges, each on its own.
void add_ranges(Time begin, const LargePairs& large, std::vector<TraceEvent>& events) {
  const auto pairs = large.items();
  if (pairs.empty()) return;
  TraceEvent all{.kind = Kind::confirm, .begin = begin, .end = begin};
  if (pairs.size() == 1) all.a = pairs.front().item.record->a, all.b = pairs.front().item.record->b;
  for (const LargePairs::Shared& pair : pairs) {
    const PairRecord& record = *pair.item.record;
    for (const LargePairs::Range& range : large.ranges(pair)) {
      const ConfirmedRange& one = range.found;
      events.push_back({Kind::range, one.thread, one.begin, one.end, record.a, record.b,
                        static_cast<std::int64_t>(one.found.size())});
    }
    all.end = std::max(all.end, pair.item.end);
    all.count += facet_pairs_of(record);
  }
  events.push_back(all);
}

void add_stages(Time begin, Time end, const StepStats& stats, std::vector<TraceEvent>& events) {
  events.push_back({Kind::detect, 0, begin, end});
  const auto add = [&](Kind kind, double ms) {
    if (ms == 0.0) return;  // nothing moved
    const Time stage_end = begin + duration_of(ms);
    events.push_back({kind, 0, begin, stage_end});
    begin = stage_end;
  };
  for (const StageTime& stage : kStageTimes) add(stage.kind, stats.*stage.ms);
  add(Kind::report, stats.report_ms);
}

bool before(const TraceEvent& x, const TraceEvent& y) {
  return std::tie(x.thread, x.begin, y.end, x.kind) < std::tie(y.thread, y.begin, x.end, y.kind);
}

}  // namespace

void StepTrace::make_room_for(std::span<const MovedPair> pairs, const PairStage& narrow_phase,
                              std::vector<TraceEvent>& events) {
  events.reserve(refreshes_.size() + kEventsOfStep + kEventsOfPair * pairs.size() + narrow_phase.large().range_count());
  by_thread_.reserve(pairs.size());
}

void StepTrace::make(Time begin, Time end, const StepStats& stats, std::span<const MovedPair> pairs,
                     const PairStage& narrow_phase, std::vector<TraceEvent>& events) {
  events.assign(refreshes_.begin(), refreshes_.end());
  add_stages(begin, end, stats, events);
  add_pairs(pairs, events);
  if (stats.kdop_separated_pairs > 0) add_separated(begin + duration_of(stats.sweep_ms), stats, events);
  add_ranges(narrow_phase.large_begin(), narrow_phase.large(), events);
  std::sort(events.begin(), events.end(), before);
}

// On the thread that called, before all other pairs; these are in order by now.
void StepTrace::add_separated(Time begin, const StepStats& stats, std::vector<TraceEvent>& events) {
  Time end = begin + std::min(duration_of(stats.kdop_ms), duration_of(stats.narrow_phase_ms));
  if (!by_thread_.empty() && by_thread_[0]->times.thread == 0) end = std::min(end, by_thread_[0]->times.begin);
  events.push_back(
      {.kind = Kind::kdop_separated_pairs, .begin = begin, .end = end, .count = stats.kdop_separated_pairs});
}

void StepTrace::add_pairs(std::span<const MovedPair> pairs, std::vector<TraceEvent>& events) {
  by_thread_.clear();
  for (const MovedPair& pair : pairs) by_thread_.push_back(pair.record);
  std::sort(by_thread_.begin(), by_thread_.end(), [](const PairRecord* x, const PairRecord* y) {
    return std::tie(x->times.thread, x->times.begin) < std::tie(y->times.thread, y->times.begin);
  });
  TraceEvent small{.kind = Kind::small_pairs};
  const auto flush = [&] {
    if (small.count > 0) events.push_back(small);
    small.count = 0;
  };
  for (std::size_t i = 0; i < by_thread_.size(); ++i) {
    const PairRecord& record = *by_thread_[i];
    const PairTimes& times = record.times;
    const bool last = i + 1 == by_thread_.size() || by_thread_[i + 1]->times.thread != times.thread;
    const Time latest = last ? Time::max() : by_thread_[i + 1]->times.begin;
    const Time::duration duration = pair_duration(times);
    const bool is_long = times.in_ranges || duration >= kLongPair;
    if (is_long || times.thread != small.thread) flush();
    if (is_long) {
      add_pair(record, latest, events);
      continue;
    }
    if (small.count == 0) small.begin = times.begin;
    small.thread = times.thread;
    small.end = std::min(times.begin + duration, latest);
    ++small.count;
  }
  flush();
}

}  // namespace tact

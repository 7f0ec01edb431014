#include "engine/step.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "engine/step_statistics.h"

namespace tact {

namespace {

using base::Timer;

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
  if (forgotten_) start_from_scratch();
  writer_.note_sources(bodies, table_, settings);
  StepStats& stats = writer_.stats() = {};
  stats.regrouped_bodies = std::exchange(regrouped_, 0);
  stats.regroup_ms = std::exchange(regroup_ms_, 0.0);
  const bool at_rest = bodies.changed().empty() && !all_;
  if (at_rest) {
    keep_last_answers();
  } else {
    look_at_pairs(bodies, settings, timer, stats);
  }
  writer_.write(table_, self_, bodies, settings);
  count_bodies(bodies, stats);
  count_pairs(table_, stats);
  stats.named_excluded_pairs = static_cast<std::int64_t>(table_.excluded());
  bodies.end_step();
  all_ = false;
  const double report_ms = timer.lap();
  if (!at_rest) stats.report_ms = report_ms;  // at rest the step is no more than this call
  stats.refresh_ms = refresh_ms;
  stats.total_ms = refresh_ms + stats.sweep_ms + stats.narrow_phase_ms + report_ms;
  make_trace(begin, timer.start(), settings);
  return writer_.report();
}

// Stages 2 to 6.
void Step::look_at_pairs(Bodies& bodies, const Settings& settings, Timer& timer, StepStats& stats) {
  sweep_.update(bodies.boxes(), bodies.filters(), bodies.changed(), settings.threads, bodies.tuning());
  bodies.place(sweep_.pairs(), settings.threads);
  table_.update(sweep_, bodies, all_);
  stats.excluded_pairs = static_cast<std::int64_t>(sweep_.excluded());
  stats.sweep_ms = timer.lap();

  pair_stage_.run(table_, bodies, settings, device_, timer);
  containment_.run(table_.moved(), bodies, settings);
  if (settings.outputs.points) points_.run(table_.moved(), bodies, settings, device_);
  self_.run(bodies, settings, all_, points_, device_);
  find_patches(bodies, settings);
  count_work(pair_stage_, stats);
  stats.narrow_phase_ms = timer.lap();
}

// Nothing moved: the last answers stand, the last events and the last work do not.
void Step::keep_last_answers() {
  table_.keep();
  self_.keep();
  pair_stage_.forget_large();
  writer_.patch_events().clear();
}

void Step::find_patches(const Bodies& bodies, const Settings& settings) {
  std::vector<PatchEvent>& events = writer_.patch_events();
  events.assign(table_.gone_patches().begin(), table_.gone_patches().end());
  if (settings.outputs.patches) {
    patches_.find(table_.moved(), bodies, settings);
    patches_.name(table_.moved(), events);
    self_.find_patches(bodies, patches_, events);
  } else if (all_) {
    for (const MovedPair& pair : table_.moved()) pair.record->patches.reset();
    self_.forget_patches();
  }
  const auto order = [](const PatchEvent& event) {
    const bool is_new = event.kind == PatchEvent::Kind::began || event.kind == PatchEvent::Kind::split;
    return std::tuple(event.a, event.b, is_new, event.patch);
  };
  std::ranges::sort(events, {}, order);
}

void Step::make_trace(TraceEvent::Time begin, TraceEvent::Time end, const Settings& settings) {
  writer_.trace().clear();
  if (settings.outputs.trace) trace_.make(begin, end, writer_.stats(), table_.moved(), pair_stage_, writer_.trace());
  trace_.forget_refreshes();
}

void Step::start_from_scratch() {
  sweep_ = {};
  table_ = {};
  pair_stage_.forget();
  points_ = {};
  containment_ = {};
  self_ = {};
  writer_.forget();
  all_ = true;
  forgotten_ = false;
}

}  // namespace tact

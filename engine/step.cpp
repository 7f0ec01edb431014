#include "engine/step.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "engine/excluded_features.h"
#include "engine/step_statistics.h"

namespace tact {

void Step::regroup(Bodies& bodies, int threads) {
  base::Timer timer;
  const std::vector<Bodies::Regrouped> regrouped = bodies.regroup(threads);
  regrouped_ = static_cast<std::int64_t>(regrouped.size());
  if (!forgotten_) stages_->table.renumber(regrouped);
  regroup_ms_ = timer.lap();
}

Renumbering Step::renumbering_of(const Bodies::VertexChange& change) {
  Renumbering renumbering(change);
  if (forgotten_) return renumbering;
  stages_->table.for_each_of(change.id, [&](PairRecord& record) { renumbering.add(record); });
  if (SelfRecord* const self = stages_->selves.find(change.id)) renumbering.add(*self);
  return renumbering;
}

void Step::renumber(const Bodies::VertexChange& change, Renumbering&& renumbering) noexcept {
  if (!forgotten_) stages_->table.renumber(change);
  renumbering.publish();
}

const Report& Step::run(Bodies& bodies, const Settings& settings, double refresh_ms) {
  base::Timer timer(settings.outputs.trace ? 0.0 : base::TickCounter::tick_ms());  // a trace needs points in time
  const TraceEvent::Time begin = timer.start();
  if (forgotten_) start_from_scratch();
  bodies.update_order();
  PairTable& table = stages_->table;
  writer_.note_sources(bodies, table, settings);
  StepStats& stats = writer_.stats() = {};
  stats.regrouped_bodies = std::exchange(regrouped_, 0);
  stats.regroup_ms = std::exchange(regroup_ms_, 0.0);
  const bool at_rest = bodies.changed().empty() && !all_ && !altered_;
  if (at_rest) {
    keep_last_answers();
  } else {
    look_at_what_moved(bodies, settings, timer, stats);
  }
  writer_.write(table, stages_->selves, bodies, settings);
  count_bodies(bodies, stats);
  count_pairs(table, stats);
  stats.named_excluded_pairs = static_cast<std::int64_t>(table.excluded());
  if (settings.outputs.trace) trace_.make_room_for(table.moved(), stages_->pairs, writer_.trace());
  if (discarded_) throw Discarded{};
  if (commit_) commit_(writer_.report());
  // From here on nothing fails.
  bodies.end_step();
  all_ = altered_ = false;
  const double report_ms = timer.lap();
  if (!at_rest) stats.report_ms = report_ms;  // at rest the step is this call alone
  stats.refresh_ms = refresh_ms;
  stats.total_ms = refresh_ms + report_ms;
  for (const StageTime& stage : kStageTimes) stats.total_ms += stats.*stage.ms;
  make_trace(begin, timer.start(), settings);
  return writer_.report();
}

// Stages 2 to 6, and what is found of their facet pairs.
void Step::look_at_what_moved(Bodies& bodies, const Settings& settings, base::Timer& timer, StepStats& stats) {
  auto& [sweep, planes, table, pairs, containment, points, selves, curves, within_reach, patches, knows_boxes] =
      *stages_;
  std::vector<std::uint32_t> slots(knows_boxes ? 0 : bodies.boxes().size());
  std::iota(slots.begin(), slots.end(), 0u);
  const std::span<const std::uint32_t> changed = knows_boxes ? bodies.changed() : slots;
  sweep.update(bodies.boxes(), bodies.filters(), changed, settings.threads, bodies.tuning());
  planes.update(bodies, bodies.boxes(), changed, sweep.pairs(), sweep.pairs_changed());
  knows_boxes = true;
  bodies.place(planes.pairs(), settings.threads);
  table.update(planes, bodies, all_);
  stats.excluded_pairs = static_cast<std::int64_t>(sweep.excluded() + planes.excluded());
  stats.sweep_ms = timer.lap();

  pairs.run(table, bodies, settings, device_, timer);
  count_work(pairs, stats);
  stats.narrow_phase_ms = timer.lap();
  containment.run(table.moved(), bodies, settings);
  stats.containment_ms = timer.lap();
  if (settings.outputs.points) {
    points.find(table.moved(), bodies, settings, device_);
    stats.points_ms = timer.lap();
  }
  selves.run(bodies, settings, all_, device_);
  if (!selves.looked_at().empty()) stats.self_facets_ms = timer.lap();
  find_curves(bodies, settings);
  if (settings.outputs.curves) stats.curves_ms = timer.lap();
  if (settings.outputs.points && !selves.looked_at().empty()) {
    points.find(selves.looked_at(), bodies, settings, device_);
    stats.self_points_ms = timer.lap();
  }
  if (settings.outputs.within_reach) {
    within_reach.find(table.moved(), selves.looked_at(), bodies, settings, device_);
    stats.within_reach_ms = timer.lap();
  }
  leave_out_excluded(table.moved(), selves.looked_at(), bodies, settings.threads);
  selves.finish(bodies);
  find_patches(patches, bodies, settings);
  if (settings.outputs.patches) stats.patches_ms = timer.lap();
}

// Nothing moved: the last answers stand, the last events and the last work do not.
void Step::keep_last_answers() {
  stages_->table.keep();
  stages_->selves.keep();
  stages_->pairs.forget_large();
  writer_.patch_events().clear();
}

void Step::find_curves(const Bodies& bodies, const Settings& settings) {
  PairTable& table = stages_->table;
  SelfStage& selves = stages_->selves;
  CurveStage& curves = stages_->curves;
  if (settings.outputs.curves) {
    curves.find(table.moved(), bodies, settings);
    curves.find(selves.looked_at(), bodies, settings);
  } else if (all_) {
    for (const MovedPair& pair : table.moved()) pair.record->curves.reset();
    for (SelfRecord* const one : selves.looked_at()) one->curves.reset();
  }
}

void Step::find_patches(PatchStage& patches, const Bodies& bodies, const Settings& settings) {
  PairTable& table = stages_->table;
  SelfStage& selves = stages_->selves;
  std::vector<PatchEvent>& events = writer_.patch_events();
  events.assign(table.gone_patches().begin(), table.gone_patches().end());
  if (settings.outputs.patches) {
    patches.find(table.moved(), bodies, settings);
    patches.name(table.moved(), bodies, events);
    events.insert(events.end(), selves.gone_patches().begin(), selves.gone_patches().end());
    patches.find(selves.looked_at(), bodies, settings);
    patches.name(selves.looked_at(), bodies, events);
  } else if (all_) {
    for (const MovedPair& pair : table.moved()) pair.record->patches.reset();
    selves.forget_patches();
  }
  const auto order = [&](const PatchEvent& event) {
    const bool is_new = event.kind == PatchEvent::Kind::began || event.kind == PatchEvent::Kind::split;
    return std::tuple(bodies.key(event.a), event.a, bodies.key(event.b), event.b, is_new, event.patch);
  };
  std::ranges::sort(events, {}, order);
}

void Step::make_trace(TraceEvent::Time begin, TraceEvent::Time end, const Settings& settings) {
  writer_.trace().clear();
  if (settings.outputs.trace)
    trace_.make(begin, end, writer_.stats(), stages_->table.moved(), stages_->pairs, writer_.trace());
  trace_.forget_refreshes();
}

void Step::restore(Restored&& restored) noexcept {
  stages_ = std::move(restored.stages);
  writer_ = std::move(restored.writer);
  all_ = restored.all;
  forgotten_ = altered_ = false;
}

void Step::start_from_scratch() {
  stages_ = std::make_unique<Stages>();
  writer_.forget();
  all_ = true;
  forgotten_ = false;
}

}  // namespace tact

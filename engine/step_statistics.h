// The statistics of a step, from what its stages counted.
#pragma once

#include <tact/statistics.h>
#include <tact/trace.h>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"
#include "engine/pair_stage.h"

namespace tact {

/// A stage after the refresh and before the report: where its time is, and the kind of its event.
struct StageTime {
  TraceEvent::Kind kind;
  double StepStats::*ms;
};
inline constexpr StageTime kStageTimes[] = {
    {TraceEvent::Kind::sweep, &StepStats::sweep_ms},
    {TraceEvent::Kind::narrow_phase, &StepStats::narrow_phase_ms},
    {TraceEvent::Kind::containment, &StepStats::containment_ms},
    {TraceEvent::Kind::points, &StepStats::points_ms},
    {TraceEvent::Kind::self_facets, &StepStats::self_facets_ms},
    {TraceEvent::Kind::curves, &StepStats::curves_ms},
    {TraceEvent::Kind::self_points, &StepStats::self_points_ms},
    {TraceEvent::Kind::within_reach, &StepStats::within_reach_ms},
    {TraceEvent::Kind::patches, &StepStats::patches_ms},
};

void count_bodies(const Bodies& bodies, StepStats& stats);
void count_pairs(const PairTable& table, StepStats& stats);
/// What stages 3 to 6 cost.
void count_work(const PairStage& narrow_phase, StepStats& stats);

}  // namespace tact

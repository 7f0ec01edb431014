// The statistics of a step, from what its stages counted.
#pragma once

#include <tact/statistics.h>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"
#include "engine/pair_stage.h"

namespace tact {

void count_bodies(const Bodies& bodies, StepStats& stats);
void count_pairs(const PairTable& table, StepStats& stats);
/// What stages 3 to 6 cost.
void count_work(const PairStage& narrow_phase, StepStats& stats);

}  // namespace tact

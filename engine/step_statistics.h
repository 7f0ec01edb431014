// The statistics of a step, put together from what its pairs and threads did.
#pragma once

#include <tact/settings.h>
#include <tact/statistics.h>

#include "engine/pair/pair_record.h"

namespace tact {

// Adds what the pair cost in this step, and how it was found.
void add_work(const PairRecord& record, const Settings& settings, StepStats& stats);

void add(StepStats& sum, const StepStats& one);

}  // namespace tact

// Statistics of several steps, added up.
#pragma once

#include <tact/statistics.h>

namespace tact::scenes {

inline void add_to(StepStats& sums, const StepStats& step) {
#define TACT_FIELD(name, text) sums.name += step.name;
  TACT_STEP_COUNTS(TACT_FIELD)
  TACT_STEP_TIMES(TACT_FIELD)
#undef TACT_FIELD
}

}  // namespace tact::scenes

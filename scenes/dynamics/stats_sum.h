// Statistics of several steps, added up.
#pragma once

#include <tact/statistics.h>

namespace tact::scenes {

inline void add_to(StepStats& sums, const StepStats& step) {
  for (const auto& field : kStepCounts) sums.*field.value += step.*field.value;
  for (const auto& field : kStepTimes) sums.*field.value += step.*field.value;
}

}  // namespace tact::scenes

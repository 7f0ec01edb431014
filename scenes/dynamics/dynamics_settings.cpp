#include "scenes/dynamics/dynamics_settings.h"

#include <algorithm>

namespace tact::scenes {

double next_reach(double reach, double last_way, const DynamicsSettings& settings) {
  const double step = settings.time_step;
  const double wanted = 1.25 * last_way * settings.substeps + settings.gravity * step * step;
  double next = settings.least_reach;
  while (next < wanted && next < settings.most_reach) next *= 2.0;
  next = std::min(next, settings.most_reach);
  const bool shrinks_little = next < reach && next > 0.3 * reach;
  return shrinks_little ? reach : next;
}

}  // namespace tact::scenes

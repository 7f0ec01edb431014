// How scripts begin and end a motion.
#pragma once

#include <algorithm>

namespace tact::scenes {

// From 0 at t = 0 to 1 at t = 1, at rest at both ends and beyond.
inline double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace tact::scenes

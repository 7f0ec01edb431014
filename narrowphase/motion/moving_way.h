// From one moving point to another, and how far doubles can be trusted with what is made of such ways.
#pragma once

#include <cmath>

#include "narrowphase/motion/moving_polygon.h"

namespace tact::narrowphase {

struct MovingWay {
  MovingVertex from, to;
};

// With u = 2^-53, a coordinate at either end is wrong by at most 5 u of the sizes that stand beside it, a volume of
// three by 22 u of the same sum of sizes, sums of three by 24 u.
inline constexpr double kWayRounding = 0x1p-47;
inline constexpr double kVanishingVolume = 0x1p-900;  // products of three below that may have lost bits

inline Vec3 magnitudes(Vec3 v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

/// A way at time 0 and at 2^-halvings, and sizes of which the rounding of its coordinates is a part.
struct WayEnds {
  Vec3 at[2], size[2];

  WayEnds() = default;
  WayEnds(const MovingWay& way, int halvings) {
    const Vec3 begin = way.to.at[0] - way.from.at[0], end = way.to.at[1] - way.from.at[1];
    const double part = std::ldexp(1.0, -halvings);
    at[0] = begin;
    at[1] = halvings == 0 ? end : begin + part * (end - begin);
    for (int axis = 0; axis < 3; ++axis) {
      const double first = std::abs(begin[axis]), last = std::abs(end[axis]);
      size[0][axis] = first;
      size[1][axis] = halvings == 0 ? last : first + part * (first + last);
    }
  }
};

/// What the terms of a volume add up to at most.
inline double sum_of_sizes(Vec3 a, Vec3 b, Vec3 c) {
  return a.x * (b.y * c.z + b.z * c.y) + a.y * (b.z * c.x + b.x * c.z) + a.z * (b.x * c.y + b.y * c.x);
}

/// Whether two vertices go the same way.
inline bool same(const MovingVertex& a, const MovingVertex& b) { return a.at[0] == b.at[0] && a.at[1] == b.at[1]; }

}  // namespace tact::narrowphase

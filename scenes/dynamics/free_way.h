// How far bodies may go until their contacts are found again.
#pragma once

#include <tact/contact_point.h>

#include <algorithm>
#include <limits>
#include <span>

namespace tact::scenes {

// Metres; infinity without points.
inline double smallest_gap(std::span<const ContactPoint> points) {
  double gap = std::numeric_limits<double>::infinity();
  for (const ContactPoint& point : points) gap = std::min(gap, point.gap);
  return gap;
}

enum class Movers { one, both };

// The way of each mover so that two surfaces cannot meet whose smallest gap this is; `thickness` is the sum of both.
inline double free_way(double gap, double thickness, Movers movers) {
  constexpr double kOfGap = 0.9;   // of a gap, for both bodies
  constexpr double kLeast = 0.05;  // of both thicknesses: what is nearer than that has to get away
  return (movers == Movers::both ? 0.5 : 1.0) * kOfGap * std::max(gap, kLeast * thickness);
}

}  // namespace tact::scenes

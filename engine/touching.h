// What touching means: for Contact::touching(), and so for Report::began() and ended().
#pragma once

#include <tact/report.h>

#include <algorithm>
#include <span>

#include "narrowphase/motion/feature_rules.h"

namespace tact {

/// Decides Contact::touching() from what a step found of two bodies, or of one with itself, with the rest offsets that
/// they have.
inline bool is_touching(std::span<const FacetPair> facet_pairs, std::span<const ContactPoint> points,
                        const narrowphase::FeatureReach& rest) {
  if (!facet_pairs.empty()) return true;
  const double largest = rest.largest();
  const bool is_uniform = rest.is_uniform();
  return std::ranges::any_of(points, [&](const ContactPoint& point) {
    return point.gap < largest && (is_uniform || point.gap < rest.of(point.a_vertices, point.b_vertices));
  });
}

}  // namespace tact

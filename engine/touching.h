// What touching means: for Contact::touching(), and so for Report::began() and ended().
#pragma once

#include <tact/report.h>

#include <algorithm>
#include <span>

namespace tact {

/// Decides Contact::touching() from what a step found of two bodies, or of one with itself, whose margins add up to
/// `reach`.
inline bool is_touching(std::span<const FacetPair> facet_pairs, std::span<const ContactPoint> points, double reach) {
  return !facet_pairs.empty() ||
         std::ranges::any_of(points, [&](const ContactPoint& point) { return point.gap < reach; });
}

}  // namespace tact

// How near the features of two surfaces come to be seen or to touch, and which do, where vertices and facets differ.
// Vertices have the caller's numbers; -1 fills up features of fewer than three.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "narrowphase/motion/feature_filter.h"

namespace tact::narrowphase {

/// What a surface adds to a distance, metres.
struct SurfaceOffset {
  double largest = 0.0;                      // of all its features
  std::span<const double> of_vertices = {};  // empty: `largest` everywhere

  /// A feature adds the largest of its vertices.
  double of(const std::array<int, 3>& vertices) const {
    if (of_vertices.empty()) return largest;
    double found = 0.0;
    for (const int v : vertices) {
      if (v >= 0) found = std::max(found, of_vertices[static_cast<std::size_t>(v)]);
    }
    return found;
  }
};

/// Of two surfaces, or of one with itself.
struct FeatureReach {
  SurfaceOffset a, b;

  double largest() const { return a.largest + b.largest; }
  bool is_uniform() const { return a.of_vertices.empty() && b.of_vertices.empty(); }
  double of(const std::array<int, 3>& vertices_a, const std::array<int, 3>& vertices_b) const {
    return a.of(vertices_a) + b.of(vertices_b);
  }
};

/// Of features that are near, or meet on their way.
struct FeatureRules {
  FeatureReach reach;
  FeatureFilter filter;

  bool are_uniform() const { return reach.is_uniform() && filter.is_uniform(); }
};

}  // namespace tact::narrowphase

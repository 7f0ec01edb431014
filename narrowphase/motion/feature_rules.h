// How near the features of two surfaces come to touch, and which do, where vertices differ. Vertices have the caller's
// numbers; -1 fills up features of fewer than three.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

/// The layers that vertices of a surface are on, and those that they are tested against.
struct VertexFilter {
  std::uint32_t layer = 1, mask = 0xffffffffu;  // of a surface whose list is empty
  std::span<const std::uint32_t> layers = {}, masks = {};

  bool is_uniform() const { return layers.empty() && masks.empty(); }
  std::uint32_t layer_of(int vertex) const {
    return layers.empty() || vertex < 0 ? layer : layers[static_cast<std::size_t>(vertex)];
  }
  std::uint32_t mask_of(int vertex) const {
    return masks.empty() || vertex < 0 ? mask : masks[static_cast<std::size_t>(vertex)];
  }
};

/// Of two surfaces, or of one with itself.
struct FeatureFilter {
  VertexFilter a, b;

  bool is_uniform() const { return a.is_uniform() && b.is_uniform(); }
  /// Two features are tested against each other if each vertex of the one is against each of the other. A plane has
  /// none, and counts as one.
  bool allows(const std::array<int, 3>& vertices_a, const std::array<int, 3>& vertices_b) const {
    for (std::size_t i = 0; i < 3 && (i == 0 || vertices_a[i] >= 0); ++i) {
      for (std::size_t k = 0; k < 3 && (k == 0 || vertices_b[k] >= 0); ++k) {
        if ((a.layer_of(vertices_a[i]) & b.mask_of(vertices_b[k])) == 0) return false;
        if ((b.layer_of(vertices_b[k]) & a.mask_of(vertices_a[i])) == 0) return false;
      }
    }
    return true;
  }
};

/// Of features that meet on their way.
struct FeatureRules {
  FeatureReach reach;
  FeatureFilter filter;

  bool are_uniform() const { return reach.is_uniform() && filter.is_uniform(); }
};

}  // namespace tact::narrowphase

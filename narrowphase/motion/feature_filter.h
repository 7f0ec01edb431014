// Which features of two surfaces, or of one, are tested against each other: by layers and masks of vertices and facets,
// by labels that are excluded, by how near they are on one surface. Vertices and facets have the caller's numbers.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "narrowphase/mesh/features.h"

namespace tact::narrowphase {

class ExcludedNeighbors;

/// What the vertices, or the facets, of a surface have; a list is empty where all have the same.
struct FilterNumbers {
  std::span<const std::uint32_t> layers = {}, masks = {};
  std::span<const std::uint32_t> labels = {};  // where any are excluded
  bool have_layers() const { return !layers.empty() || !masks.empty(); }
  bool are_uniform() const { return !have_layers() && labels.empty(); }
};

struct SurfaceFilter {
  std::uint32_t layer = 1, mask = 0xffffffffu;  // of what has no others: a plane, edges and points among facets
  FilterNumbers of_vertices = {}, of_facets = {};
  /// Tells which facets have a feature. Without Features no more than allows_vertices() and allows_facets() may be
  /// called.
  FeaturedMesh surface = {};
};

/// A label of the first surface and one of the second.
using TwoLabels = std::array<std::uint32_t, 2>;

/// Of two surfaces, or of one with itself.
struct FeatureFilter {
  SurfaceFilter a, b;
  std::span<const TwoLabels> excluded_of_vertices = {}, excluded_of_facets = {};  // sorted
  const ExcludedNeighbors* neighbors = nullptr;                                   // of one surface

  bool is_uniform() const;
  /// Two features are tested against each other if each vertex of the one is against each of the other, and any facet
  /// that has the one against any that has the other. A plane has neither, and counts as one.
  bool allows(const std::array<int, 3>& vertices_a, const std::array<int, 3>& vertices_b) const {
    return allows_vertices(vertices_a, vertices_b) && (!is_of_facets() || allows_any_facets(vertices_a, vertices_b));
  }
  bool allows_vertices(const std::array<int, 3>& vertices_a, const std::array<int, 3>& vertices_b) const;
  /// Of two facets, edges or points; -1 is a plane.
  bool allows_facets(int facet_a, int facet_b) const;

 private:
  bool is_of_facets() const { return !a.of_facets.are_uniform() || !b.of_facets.are_uniform(); }
  bool allows_any_facets(const std::array<int, 3>& vertices_a, const std::array<int, 3>& vertices_b) const;
};

}  // namespace tact::narrowphase

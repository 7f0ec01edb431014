// Two features of two surfaces, or of one, that are near each other.
#pragma once

#include <tact/feature_pair.h>

#include <array>

namespace tact {

/// A vertex and a facet, or two edges, that are nearer to each other than the sum of the margins. Of one body, features
/// without a common vertex.
struct ReachPair {
  /// vertex_facet, facet_vertex or edge_edge: a vertex and an edge or a vertex of no facet go by the first two.
  FeaturePair kind = FeaturePair::vertex_facet;
  /// Vertices of the feature of a, each once; -1 fills up. Those of edges ascend.
  std::array<int, 3> a_vertices{-1, -1, -1};
  /// The same of b.
  std::array<int, 3> b_vertices{-1, -1, -1};
  /// Weights, with a sum of 1, of the place of a nearest to b; above zero are those of the closest vertex, edge or
  /// facet alone.
  std::array<double, 3> a_weights{};
  /// The same of b.
  std::array<double, 3> b_weights{};
  /// Unit vector from the place of a to that of b; zero where the two coincide.
  std::array<double, 3> normal{};
  /// How far the two places are apart, metres.
  double distance = 0.0;
};

}  // namespace tact

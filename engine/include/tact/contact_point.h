// Where two surfaces are nearest to each other.
#pragma once

#include <tact/feature_pair.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace tact {

/// A point on each of two surfaces that are nearer than the sum of their margins, where the distance has a local
/// minimum: a vertex and the nearest place of a facet, of an edge or of another vertex; or the insides of two edges.
///
/// A point of a surface is the sum of its vertices times their weights:
///
///     p_a = sum over k of a_weights[k] * position of a's vertex a_vertices[k]
struct ContactPoint {
  FeaturePair kind = FeaturePair::vertex_facet;
  /// The patch that it belongs to, counted from 0: points that are connected by common vertices.
  int patch = 0;
  /// Vertices of a and of b, of the smallest feature that holds the point; -1 fills up. Those of an edge ascend, those
  /// of a facet stand in its own order.
  std::array<int, 3> a_vertices{-1, -1, -1};
  std::array<int, 3> b_vertices{-1, -1, -1};
  /// Their weights, not negative; the sum on either side is 1.
  std::array<double, 3> a_weights{};
  std::array<double, 3> b_weights{};
  /// Unit vector from the point of a to that of b. Where these are one point: the normal of a facet there.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// How far the two points are apart along the normal, metres.
  double gap = 0.0;
  /// The same in every step in which these features of these bodies are near each other: a key for what a solver keeps,
  /// impulses say. Two points of a world have the same with a probability of 2^-64.
  std::uint64_t id = 0;
};

}  // namespace tact

// Where two surfaces are nearest to each other.
#pragma once

#include <tact/feature_pair.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace tact {

/// A point on each of two surfaces, where features are nearest or have crossed. The manual draws which ones: for each
/// vertex the local minima of its distance, and the pairs of edges. A point is the sum of its vertices times their
/// weights:
///
///     p_a = sum over k of a_weights[k] * position of vertex a_vertices[k] of a
struct ContactPoint {
  FeaturePair kind = FeaturePair::vertex_facet;
  /// The number of its patch, counted from 0: an index into Contact::patches(), if Outputs::patches is set.
  int patch = 0;
  /// Vertices of the smallest feature of a that holds the point; -1 fills up. Those of edges ascend.
  std::array<int, 3> a_vertices{-1, -1, -1};
  /// The same of b. A plane has none: the point of it is a gap along the normal from the other one.
  std::array<int, 3> b_vertices{-1, -1, -1};
  /// Weights of the vertices of a, not negative, with a sum of 1.
  std::array<double, 3> a_weights{};
  /// The same of b.
  std::array<double, 3> b_weights{};
  /// Unit vector from the point of a to that of b; the normal of a facet where the two coincide.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// The distance of the two points along the normal, metres; negative where the surfaces have crossed.
  double gap = 0.0;
  /// The same in every step in which these features are near: a key for impulses.
  std::uint64_t id = 0;
  /// Whether nothing beside it on either surface is nearer along its normal, which lies in the normal cones of both
  /// features. Others are minima for a vertex alone.
  bool minimum = false;
};

}  // namespace tact

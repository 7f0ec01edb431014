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
/// Where surfaces cross, whatever the margins, `gap` is negative, and moving b by -gap * normal takes the two points
/// back to each other:
///   - each vertex that is inside a closed body, decided exactly, has one point: with the nearest place of the surface
///     on the side that it came from. That is the side of its normal in the last step; or that of its patch; for a
///     patch that is new, the side on which its edges come in, or that of the contact direction where these do not
///     agree. So the gap of a shallow vertex is its distance from the surface, and a vertex deep in a thin part keeps
///     its side. It is never deeper than the hulls of the contact overlap;
///   - each vertex on the wrong side of a sheet, as far as it hangs together with an edge that the sheet cuts, has one:
///     the wrong side is the other one than in the last step, or that of its patch; for a patch that is new, the one to
///     which corners of the sheet leave a closed body they came into, or the other one than the contact direction's;
///   - two edges that have passed each other have one, if one meets a facet of the other; an edge that runs through a
///     closed body has one with the nearest edge that it has passed, if there is one.
/// A closed body that crosses itself, or a sheet without a margin, has them, too; a sheet with a margin has none.
///
/// A point of a surface is the sum of its vertices times their weights:
///
///     p_a = sum over k of a_weights[k] * position of a's vertex a_vertices[k]
struct ContactPoint {
  FeaturePair kind = FeaturePair::vertex_facet;
  /// The patch that it belongs to, counted from 0: an index into Contact::patches(), if these are asked for. See Patch.
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
  /// How far the two points are apart along the normal, metres; negative where the surfaces have crossed.
  double gap = 0.0;
  /// The same in every step in which these features of these bodies are near each other, and so the key to a table of
  /// the program's own: impulses of the last step to start the next from, say. A world keeps no value for it: a solver
  /// has several numbers a point (one along the normal, two across), knows when they are worth keeping, and would pay
  /// for a search twice. Two points of a world have the same id with a probability of 2^-64.
  std::uint64_t id = 0;
};

}  // namespace tact

// The curves in which two surfaces cross.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

namespace tact {

/// Where an edge of one surface goes through a facet of the other; a corner of an intersection curve.
struct CurvePoint {
  /// Metres; the exact place, rounded once.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double fraction = 0.0;  ///< how far along the edge, 0 to 1
  /// The vertices of the edge, ascending. The second is -1 at a common vertex of two facets of one body.
  std::array<int, 2> edge{-1, -1};
  int facet = -1;  ///< the facet that the edge goes through; -1 at a common vertex
  /// The facets that hold the way to the next point: an index into Contact::facet_pairs(). -1: no way leads on.
  int facet_pair = -1;
  bool edge_of_b = false;  ///< whether the edge is of b, and the facet of a
};

/// A polyline of points on both surfaces. The way in its first facet pair leads along the normal of a's facet times
/// that of b's.
struct IntersectionCurve {
  bool closed = false;                 ///< whether the last point leads on to the first
  std::span<const CurvePoint> points;  ///< in order
};

}  // namespace tact

// Queries of whole bodies: how far they are apart, when one that is moved meets others, how much they overlap.
#pragma once

#include <tact/body.h>
#include <tact/queries.h>
#include <tact/report.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>

namespace tact {

/// Two bodies, and how far they may be apart.
struct DistanceQuery {
  BodyId a;                                                 ///< the first body
  BodyId b;                                                 ///< another body
  double within = std::numeric_limits<double>::infinity();  ///< metres, at least 0: what is farther is not looked for
};

/// Which bodies are nearest to a body.
struct NearestBodiesQuery {
  BodyId body;                                              ///< the body from which distances are measured
  std::size_t count = 1;                                    ///< how many bodies at most
  double within = std::numeric_limits<double>::infinity();  ///< metres, at least 0
  QueryFilter filter = {};                                  ///< which bodies it considers
};

/// The least distance of the surfaces of two bodies, and where it is; of equally near facets the least of a, then of b.
/// A plane is solid: what reaches below it is at distance zero. Edges and points count as in ClosestPoint.
struct BodyDistance {
  BodyId a;  ///< the first body, as requested
  BodyId b;  ///< the second body
  /// Metres: zero exactly where the surfaces share a point, else right to 1e-12 of both bodies' size; infinity where
  /// they are farther apart than requested.
  double distance = std::numeric_limits<double>::infinity();
  int a_facet = -1;                       ///< negative: farther apart than requested
  int b_facet = -1;                       ///< likewise
  std::array<double, 3> a_barycentric{};  ///< the place on a's facet: weights of its corners; zero on a plane
  std::array<double, 3> b_barycentric{};  ///< the place on b's facet
  Containment containment{};              ///< whether one lies wholly inside the other, whose surfaces are apart
};

/// A way of a body as a whole: it goes straight and turns at the same time, both evenly. At fraction s a vertex at p is
/// at center + s * way + R * (p - center), where R turns about `axis` by s * angle.
struct Sweep {
  BodyId body;                                       ///< the body that is moved, from where it is now
  Eigen::Vector3d way = Eigen::Vector3d::Zero();     ///< how far it goes, metres
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< what it turns about, of any length but zero
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< a point of the axis where the way begins, metres
  double angle = 0.0;                                ///< radians, at most 1000 in size; counter-clockwise about `axis`
  QueryFilter filter = {};                           ///< which other bodies it considers
};

/// The first facet that a swept body meets; of equal fractions the least by body, then by facets.
struct SweepHit {
  BodyId body;     ///< the body that is met
  int facet = -1;  ///< of the swept body; negative: it meets nothing
  int other = -1;  ///< the facet of `body` that it meets
  /// The part of the way, 0 to 1, that is free: never later than the true one. Earlier by the time that the facets take
  /// for the last 1e-13 of their size and way.
  double fraction = 1.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector from `facet` to `other`; zero if they meet at once
  std::array<double, 3> barycentric{};               ///< the place on `facet`: weights of its corners
  std::array<double, 3> other_barycentric{};         ///< the place on `other`
};

/// What two closed bodies have in common.
struct Overlap {
  double volume = 0.0;  ///< cubic metres
  double area = 0.0;    ///< of its surface, square metres; zero where the bodies only touch
};

}  // namespace tact

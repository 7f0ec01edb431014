// Queries to the surfaces of a world: rays, nearest points, boxes, containment. Of a plane the surface is facet 0,
// which has no corners, and weights are zero.
#pragma once

#include <tact/body.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

namespace tact {

/// Which bodies a query considers: those whose layer and `mask` have a common bit, as have their mask and `layer`.
struct QueryFilter {
  std::uint32_t layer = 0xffffffffu;  ///< the layers that the query is on
  std::uint32_t mask = 0xffffffffu;   ///< the layers that the query considers
};

/// A segment, ends included.
struct Ray {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< metres
  QueryFilter filter = {};                         ///< which bodies it considers
};

/// Which facet World::cast_ray() returns.
enum class RayHits {
  first,  ///< the first facet on the way; of several at one place the least by body and facet
  any,    ///< some facet on the way; faster
};

/// A facet that a ray meets. That it does is exact, so no ray slips through between facets. The fraction is the exact
/// one, rounded once: facets at one place share it. Weights are right to 1e-12 of the size of facet and ray.
struct RayHit {
  BodyId body;            ///< the body of the facet
  int facet = -1;         ///< negative: the ray meets nothing
  double fraction = 0.0;  ///< the place on the ray: from + fraction * (to - from)
  std::array<double, 3>
      barycentric{};  ///< the place on the facet: weights of its corners, not negative, with a sum of 1
};

/// A point, and how far the answer may be away.
struct PointQuery {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();          ///< metres
  double within = std::numeric_limits<double>::infinity();  ///< metres, at least 0
  QueryFilter filter = {};                                  ///< which bodies it considers
};

/// The nearest place of all surfaces; of equally near ones the least by body and facet. The distance is the exact one,
/// rounded once. Weights are right to 1e-12 of the distance and the size of the bodies. Edges count as facets after the
/// facets, and points after the edges.
struct ClosestPoint {
  BodyId body;                                                ///< the body of the facet
  int facet = -1;                                             ///< negative: no facet is within reach
  double distance = std::numeric_limits<double>::infinity();  ///< metres; infinity where no facet is within reach
  std::array<double, 3>
      barycentric{};  ///< the place on the facet: weights of its corners, not negative, with a sum of 1
};

/// A closed box.
struct BoxQuery {
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();  ///< metres, not below `lower`
  QueryFilter filter = {};                          ///< which bodies it considers
};

/// A facet of a body. Edges and points count as in ClosestPoint.
struct FacetOfBody {
  BodyId body;    ///< the body of the facet
  int facet = 0;  ///< counted from 0
  friend bool operator==(const FacetOfBody&, const FacetOfBody&) = default;
};

}  // namespace tact

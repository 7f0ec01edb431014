// What can be asked of a world at any time: segments, nearest points, boxes, what is inside what.
#pragma once

#include <tact/body.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

namespace tact {

/// Which bodies are asked: those whose layer has a bit in `mask`, and whose mask has one in `layer`, as between bodies.
struct QueryFilter {
  std::uint32_t layer = 0xffffffffu;
  std::uint32_t mask = 0xffffffffu;
};

/// A ray from one point to another, metres. Its ends belong to it.
struct Ray {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  QueryFilter filter = {};
};

enum class RayHits {
  first,  ///< the first facet; of several at one place the least by body and facet
  any,    ///< some facet: is anything in the way? Faster
};

/// A facet that a ray meets. Whether it does is decided exactly, edges and corners belong to the facets that have them:
/// no ray slips through between two. Where it does is right to 1e-12 of the size of facet and ray.
struct RayHit {
  BodyId body;
  int facet = -1;                       ///< negative: nothing was hit
  double fraction = 0.0;                ///< where, as a part of the way: from + fraction * (to - from)
  std::array<double, 3> barycentric{};  ///< of the facet's corners at that place; not negative, their sum is 1
};

/// A point, metres, and how far away the answer may be.
struct PointQuery {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double within = std::numeric_limits<double>::infinity();
  QueryFilter filter = {};
};

/// The nearest place of all surfaces; of equally near ones the least by body and facet. Right to 1e-12 of the distance
/// and the size of the bodies.
struct ClosestPoint {
  BodyId body;
  int facet = -1;                                             ///< negative: nothing is as near as was asked
  double distance = std::numeric_limits<double>::infinity();  ///< metres
  std::array<double, 3> barycentric{};                        ///< of the facet's corners at the nearest place
};

/// A box, metres; closed.
struct BoxQuery {
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
  QueryFilter filter = {};
};

/// A facet of a body.
struct FacetOfBody {
  BodyId body;
  int facet = 0;
  friend bool operator==(const FacetOfBody&, const FacetOfBody&) = default;
};

}  // namespace tact

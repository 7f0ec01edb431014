// What all drawings are made of: arrows, circles, and how wide a world is.
#pragma once

#include <tact/debug_draw.h>

#include <Eigen/Core>
#include <string>

namespace tact {

inline bool is_empty(const Bounds& bounds) { return bounds.lower[0] > bounds.upper[0]; }
inline Eigen::Vector3d lower(const Bounds& bounds) { return Eigen::Map<const Eigen::Vector3d>(bounds.lower.data()); }
inline Eigen::Vector3d upper(const Bounds& bounds) { return Eigen::Map<const Eigen::Vector3d>(bounds.upper.data()); }
// Halved first: the sum of two coordinates is in range so, too.
inline Eigen::Vector3d middle(const Bounds& bounds) { return 0.5 * lower(bounds) + 0.5 * upper(bounds); }
inline double size(const Bounds& bounds) { return (upper(bounds) - lower(bounds)).norm(); }

/// Of the bodies that have an end; empty without any.
Bounds bounds_of_all(const World& world);
/// The place of a plane that is nearest to a point.
Eigen::Vector3d foot(const Plane& plane, const Eigen::Vector3d& point);
/// A length in three digits.
std::string metres(double value);

class Pen {
 public:
  explicit Pen(DebugDrawer& drawer) : drawer_(drawer) {}
  void arrow(const Eigen::Vector3d& from, const Eigen::Vector3d& way, const DebugColor& color);
  /// Across n, a unit vector.
  void circle(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& n, const DebugColor& color);

 private:
  DebugDrawer& drawer_;
};

}  // namespace tact

// How much light a point gets.
#pragma once

#include <Eigen/Core>
#include <span>

#include "scenes/pictures/drawn_scene.h"
#include "scenes/pictures/sampling.h"

namespace tact::scenes {

// The points of the unit square that one sample uses, for the sky and for the sun.
using BundlePoints = std::array<SquarePoint, kBundle>;

// A point that is lit, in the units of the drawn scene.
struct LitPoint {
  Eigen::Vector3f place;   // a little above the surface
  Eigen::Vector3f normal;  // unit, towards the viewer's side
};

// A sun at the viewer's upper left, a sky that is brighter above, and the light that a white floor throws back.
class Lights {
 public:
  // `scene` must stay alive.
  explicit Lights(const DrawnScene& scene);

  // The direction to the sun, unit.
  const Eigen::Vector3f& sun() const { return sun_; }
  // Light from the sky that a white surface throws back; where rays are blocked it gets a little of `bounce`.
  Light sky(const LitPoint& point, const BundlePoints& points, const Light& bounce) const;
  // The share of the sun that is seen, 0 to 1.
  float sun_seen(const LitPoint& point, const BundlePoints& points) const;

 private:
  const DrawnScene& scene_;
  Eigen::Vector3f sun_;
  Tangents across_sun_;
};

}  // namespace tact::scenes

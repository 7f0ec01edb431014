// How much light a point gets.
#pragma once

#include <Eigen/Core>

#include "scenes/pictures/drawn_scene.h"
#include "scenes/pictures/light_buffer.h"
#include "scenes/pictures/sampling.h"

namespace tact::scenes {

// A sun at the viewer's upper left, a sky that is brighter above, and the light that a white floor throws back.
class Lights {
 public:
  // `scene` must stay alive.
  explicit Lights(const DrawnScene& scene);

  // The direction to the sun, unit.
  const Eigen::Vector3f& sun() const { return sun_; }
  const Light& sun_light() const { return sun_light_; }
  // Light from the sky on a level surface with nothing in the way.
  Light open_sky() const;
  // May an opaque body keep light away from the point? If not, all of the sky above it and of the sun are seen.
  bool near_sky(const Eigen::Vector3f& place) const;
  bool near_sun(const Eigen::Vector3f& place) const;
  // Light from the sky and from the floor; where rays are blocked it is `bounce` instead.
  Light sky(const LitPoint& point, const DiskPoints& points, const Light& bounce) const;
  // The share of the sun that is seen, 0 to 1.
  float sun_seen(const LitPoint& point, const DiskPoints& points) const;

 private:
  const DrawnScene& scene_;
  Eigen::Vector3f sun_;
  Light sun_light_{1.42f, 1.34f, 1.2f};
  Tangents across_sun_;
};

}  // namespace tact::scenes

// The light on what each pixel shows. Light changes slowly over a surface, unlike colour: a few rays a pixel, averaged
// over the neighbours that show the same surface, serve all samples of the pixel.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/pictures/drawn_scene.h"

namespace tact::scenes {

// A point that is lit, in the units of the drawn scene.
struct LitPoint {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();   // a little above the surface
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, towards the viewer's side; zero: nothing is here
  const DrawnMesh* mesh = nullptr;                   // null: the floor
};

struct Lighting {
  Light sky = Light::Zero();
  float sun_seen = 0.0f;  // share of the sun, 0 to 1
};

class LightBuffer {
 public:
  LightBuffer(int width, int height);

  // One thread a pixel.
  void set(int x, int y, const LitPoint& point, const Lighting& lighting);
  // Gives each pixel the mean of the pixels up to `reach` away that lie on the same piece of surface.
  void smooth(int reach, int threads);
  // The light of the pixel, or of a neighbour, that lies on the same piece of surface as `point`; null if none does.
  const Lighting* find(int x, int y, const LitPoint& point) const;

 private:
  std::size_t index(int x, int y) const;
  Lighting mean(int x, int y, int reach) const;

  int width_;
  int height_;
  std::vector<LitPoint> points_;
  std::vector<Lighting> lights_;
};

}  // namespace tact::scenes

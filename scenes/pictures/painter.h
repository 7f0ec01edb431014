// The colour of a pixel.
#pragma once

#include <optional>
#include <span>

#include "scenes/pictures/drawn_scene.h"
#include "scenes/pictures/light.h"
#include "scenes/pictures/light_buffer.h"
#include "scenes/pictures/sampling.h"

namespace tact::scenes {

// Paints a drawn scene in two rounds over the pixels, each in any order and by any number of threads: light() for every
// pixel, then smooth_light(), then color() for every pixel.
class Painter {
 public:
  // `samples_per_pixel` is 1 or 4; `scene` must stay alive.
  Painter(const DrawnScene& scene, int width, int height, int samples_per_pixel);

  // Finds the light on what is seen at the middle of the pixel.
  void light(int x, int y);
  void smooth_light(int threads);
  Color color(int x, int y) const;

 private:
  // A place in the picture, in pixels.
  struct Place {
    float x = 0.0f;
    float y = 0.0f;
  };
  // What a ray meets: a mesh, or the floor.
  struct Met {
    float distance = 0.0f;
    LitPoint point;
    bool inner = false;  // the side from which the facet turns clockwise
    float edge = 0.0f;   // how much of an edge of the facet is seen, 0 to 1
  };

  Ray ray(const Place& place) const;
  Light backdrop(const Place& place) const;
  std::optional<Met> meet(const Ray& ray) const;
  Met met(const DrawnMesh& mesh, const RayHit& hit, const Ray& ray) const;
  float edge_seen(const DrawnMesh& mesh, const RayHit& hit) const;
  Lighting lighting(const LitPoint& point, const DiskPoints& points) const;
  Lighting stored_lighting(const LitPoint& point, const Place& place) const;
  Light trace(const Place& place) const;
  Light shaded(const Met& met, const Ray& ray, const Place& place) const;
  Light floor(const Met& met, const Place& place) const;
  Light marked(const Light& seen, const DrawnLayer& layer, const Ray& ray, float distance) const;

  const DrawnScene& scene_;
  Lights lights_;
  int width_;
  int height_;
  std::span<const Place> samples_;
  DiskPattern pattern_;
  LightBuffer buffer_;
  Light backdrop_top_;
  Light backdrop_bottom_;

  static const Place kOneSample[1];
  static const Place kFourSamples[4];
};

}  // namespace tact::scenes

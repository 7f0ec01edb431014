// The colour of a pixel.
#pragma once

#include <optional>
#include <vector>

#include "scenes/pictures/drawn_scene.h"
#include "scenes/pictures/light.h"
#include "scenes/pictures/light_buffer.h"
#include "scenes/pictures/sampling.h"

namespace tact::scenes {

// Paints a drawn scene in three rounds over the pixels, each in any order and by any number of threads: light() for
// every pixel, then smooth_light(), then sketch() for every pixel, then color() for every pixel.
//
// With four samples a pixel, only pixels that differ from a neighbour get all of them; the others keep the one of the
// sketch. After T. Whitted, An Improved Illumination Model for Shaded Display, CACM 1980.
class Painter {
 public:
  // `samples_per_pixel` is 1 or 4; `scene` must stay alive.
  Painter(const DrawnScene& scene, int width, int height, int samples_per_pixel);

  // Finds the light on what is seen at the middle of the pixel.
  void light(int x, int y);
  void smooth_light(int threads);
  // Traces the middle of the pixel.
  void sketch(int x, int y);
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

  std::size_t index(int x, int y) const;
  // Do all neighbours of the pixel look as it does, as far as the sketch tells?
  bool calm(int x, int y) const;
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
  bool fine_;
  DiskPattern pattern_;
  LightBuffer buffer_;
  std::vector<Light> sketch_;  // by pixel, row by row
  Light backdrop_top_;
  Light backdrop_bottom_;

  static const Place kFourSamples[4];
};

}  // namespace tact::scenes

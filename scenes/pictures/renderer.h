// From a scene to a picture, by rays on the CPU: sun with soft shadows, light from the sky that corners get less of,
// smooth surfaces, see-through marks.
#pragma once

#include "scenes/pictures/camera.h"
#include "scenes/pictures/picture.h"
#include "scenes/pictures/picture_scene.h"
#include "scenes/pictures/text.h"

namespace tact::scenes {

enum class Quality {
  draft,  // one sample a pixel: rough rims
  fine,   // four samples a pixel where neighbours differ
};

struct RenderSettings {
  int width = 1280;  // pixels, at least 1
  int height = 720;
  Quality quality = Quality::fine;
  int threads = 0;  // 0: as many as OpenMP would use
};

// Takes pictures. The same scene and camera give the same bytes for any number of threads; another kind of processor
// may round rays differently. One picture at a time; different renderers may work at once.
class Renderer {
 public:
  // Errors: std::runtime_error if the font for titles is missing or the size is not positive.
  explicit Renderer(const RenderSettings& settings = {});

  const RenderSettings& settings() const { return settings_; }

  // Facets must name vertices of their body and positions be finite. A mark that a body hides shines through it.
  // Errors: tact::Error, out_of_memory or backend_failure.
  Picture render(const PictureScene& scene, const Camera& camera);
  // The same from framing() of what this scene shows, marks included.
  Picture render(const PictureScene& scene);

 private:
  RenderSettings settings_;
  Font font_;
};

}  // namespace tact::scenes

#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

base::Box bounding_box(const PictureScene& scene) {
  base::Box box;
  for (const PictureBody& body : scene.bodies) {
    for (const int vertex : body.facets.reshaped()) {
      const auto p = body.positions.col(vertex);
      box = base::extended(box, {p.x(), p.y(), p.z()});
    }
  }
  return box;
}

}  // namespace tact::scenes

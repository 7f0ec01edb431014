#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

Eigen::Matrix3Xd used_positions(const PictureScene& scene) {
  Eigen::Index count = 0;
  for (const PictureBody& body : scene.bodies) count += body.facets.size();
  Eigen::Matrix3Xd positions(3, count);
  Eigen::Index next = 0;
  for (const PictureBody& body : scene.bodies) {
    for (const int vertex : body.facets.reshaped()) positions.col(next++) = body.positions.col(vertex);
  }
  return positions;
}

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

#include "scenes/pictures/picture_scene.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace tact::scenes {

Eigen::Matrix3Xd shown_points(const PictureScene& scene) {
  constexpr int kRimPoints = 16;
  Eigen::Index count = static_cast<Eigen::Index>(2 * scene.arrows.size() + kRimPoints * scene.disks.size());
  for (const PictureBody& body : scene.bodies) count += body.facets.size();
  Eigen::Matrix3Xd points(3, count);
  Eigen::Index next = 0;
  for (const PictureBody& body : scene.bodies) {
    for (const int vertex : body.facets.reshaped()) points.col(next++) = body.positions.col(vertex);
  }
  for (const Arrow& arrow : scene.arrows) {
    points.col(next++) = arrow.start;
    points.col(next++) = arrow.start + arrow.length * arrow.direction;
  }
  for (const Disk& disk : scene.disks) {
    const Eigen::Vector3d u = disk.normal.unitOrthogonal();
    const Eigen::Vector3d v = disk.normal.cross(u);
    for (int i = 0; i < kRimPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRimPoints;
      points.col(next++) = disk.center + disk.radius * (std::cos(angle) * u + std::sin(angle) * v);
    }
  }
  return points;
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

#include "scenes/pictures/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tact::scenes {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

// The direction from the scene to the camera.
Eigen::Vector3d view_direction(UpAxis up, const View& view) {
  const double azimuth = radians(view.azimuth);
  const double elevation = radians(view.elevation);
  const double across = std::cos(elevation);
  const Eigen::Vector3d y_up(across * std::sin(azimuth), std::sin(elevation), across * std::cos(azimuth));
  return up == UpAxis::y ? y_up : Eigen::Vector3d(y_up.x(), -y_up.z(), y_up.y());
}

Eigen::Matrix3Xd corners(const base::Box& box) {
  Eigen::Matrix3Xd points(3, 8);
  for (int i = 0; i < 8; ++i) {
    points.col(i) << (i & 1 ? box.upper.x : box.lower.x), (i & 2 ? box.upper.y : box.lower.y),
        (i & 4 ? box.upper.z : box.lower.z);
  }
  return points;
}

// The points, or a small cube around them if they are all in one place: the camera must keep a distance from it.
Eigen::Matrix3Xd with_room(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d lower = points.rowwise().minCoeff();
  const Eigen::Vector3d upper = points.rowwise().maxCoeff();
  const double farthest = points.cwiseAbs().maxCoeff();
  if ((upper - lower).maxCoeff() > 1e-9 * farthest) return points;
  const double room = std::max(1e-6 * farthest, 1e-3);
  return corners(
      {{lower.x() - room, lower.y() - room, lower.z() - room}, {upper.x() + room, upper.y() + room, upper.z() + room}});
}

// How far back and aside a camera must stand to see every point between two planes through it: seen along one axis of
// the picture, point i lies inside if |across_i - shift| <= tangent * (along_i - place).
struct Fit {
  double place = 0.0;
  double shift = 0.0;
};

Fit fit(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& along, const Eigen::Vector3d& across, double tangent) {
  const double high = ((across - tangent * along).transpose() * points).maxCoeff();
  const double low = ((-across - tangent * along).transpose() * points).maxCoeff();
  return {.place = -(high + low) / (2.0 * tangent), .shift = (high - low) / 2.0};
}

}  // namespace

Camera framing(const Eigen::Matrix3Xd& shown, UpAxis up, int width, int height, const View& view) {
  if (shown.cols() == 0) return framing(base::Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, up, width, height, view);
  const Eigen::Matrix3Xd points = with_room(shown);
  Camera camera;
  camera.forward = -view_direction(up, view);
  camera.right = camera.forward.cross(up_vector(up)).normalized();
  camera.down = camera.forward.cross(camera.right);
  const double diagonal = std::hypot(width, height);
  camera.tangent_x = std::tan(radians(view.angle_of_view) / 2.0) * width / diagonal;
  camera.tangent_y = std::tan(radians(view.angle_of_view) / 2.0) * height / diagonal;

  const Fit x = fit(points, camera.forward, camera.right, (1.0 - view.margin) * camera.tangent_x);
  const Fit y = fit(points, camera.forward, camera.down, (1.0 - view.margin) * camera.tangent_y);
  camera.position = std::min(x.place, y.place) * camera.forward + x.shift * camera.right + y.shift * camera.down;
  const Eigen::RowVectorXd depths = camera.forward.transpose() * (points.colwise() - camera.position);
  camera.focus = 0.5 * (depths.minCoeff() + depths.maxCoeff());
  return camera;
}

Camera framing(const base::Box& box, UpAxis up, int width, int height, const View& view) {
  if (box.empty()) return framing(Eigen::Matrix3Xd(3, 0), up, width, height, view);
  return framing(corners(box), up, width, height, view);
}

PicturePoint project(const Camera& camera, const Eigen::Vector3d& point, int width, int height) {
  const Eigen::Vector3d from = point - camera.position;
  const double depth = camera.forward.dot(from);
  const double x = camera.right.dot(from) / (depth * camera.tangent_x);
  const double y = camera.down.dot(from) / (depth * camera.tangent_y);
  return {.x = 0.5 * (1.0 + x) * width, .y = 0.5 * (1.0 + y) * height, .depth = depth};
}

}  // namespace tact::scenes

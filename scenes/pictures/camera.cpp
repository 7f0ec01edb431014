#include "scenes/pictures/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

std::array<Eigen::Vector3d, 8> corners(const base::Box& box) {
  const base::Box shown = box.empty() ? base::Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}} : box;
  Eigen::Vector3d lower(shown.lower.x, shown.lower.y, shown.lower.z);
  Eigen::Vector3d upper(shown.upper.x, shown.upper.y, shown.upper.z);
  // The camera must keep a distance from a single point too.
  const double extent = (upper - lower).maxCoeff();
  if (extent <= 1e-9 * std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff()) || extent == 0.0) {
    const double room = std::max(1e-6 * lower.cwiseAbs().maxCoeff(), 1e-3);
    lower.array() -= room;
    upper.array() += room;
  }
  std::array<Eigen::Vector3d, 8> result;
  for (std::size_t i = 0; i < 8; ++i) {
    result[i] = {i & 1 ? upper.x() : lower.x(), i & 2 ? upper.y() : lower.y(), i & 4 ? upper.z() : lower.z()};
  }
  return result;
}

// How far back and aside a camera must stand to see every corner between two planes through it: seen along one axis of
// the picture, corner i lies inside if |across_i - shift| <= tangent * (along_i - place).
struct Fit {
  double place = 0.0;
  double shift = 0.0;
};

Fit fit(const std::array<Eigen::Vector3d, 8>& points, const Eigen::Vector3d& along, const Eigen::Vector3d& across,
        double tangent) {
  double high = -std::numeric_limits<double>::infinity();
  double low = high;
  for (const Eigen::Vector3d& point : points) {
    high = std::max(high, across.dot(point) - tangent * along.dot(point));
    low = std::max(low, -across.dot(point) - tangent * along.dot(point));
  }
  return {.place = -(high + low) / (2.0 * tangent), .shift = (high - low) / 2.0};
}

}  // namespace

Camera framing(const base::Box& box, UpAxis up, int width, int height, const View& view) {
  Camera camera;
  camera.forward = -view_direction(up, view);
  camera.right = camera.forward.cross(up_vector(up)).normalized();
  camera.down = camera.forward.cross(camera.right);
  const double diagonal = std::hypot(width, height);
  camera.tangent_x = std::tan(radians(view.angle_of_view) / 2.0) * width / diagonal;
  camera.tangent_y = std::tan(radians(view.angle_of_view) / 2.0) * height / diagonal;

  const std::array<Eigen::Vector3d, 8> points = corners(box);
  const Fit x = fit(points, camera.forward, camera.right, (1.0 - view.margin) * camera.tangent_x);
  const Fit y = fit(points, camera.forward, camera.down, (1.0 - view.margin) * camera.tangent_y);
  camera.position = std::min(x.place, y.place) * camera.forward + x.shift * camera.right + y.shift * camera.down;
  camera.focus = camera.forward.dot(0.5 * (points.front() + points.back()) - camera.position);
  return camera;
}

PicturePoint project(const Camera& camera, const Eigen::Vector3d& point, int width, int height) {
  const Eigen::Vector3d from = point - camera.position;
  const double depth = camera.forward.dot(from);
  const double x = camera.right.dot(from) / (depth * camera.tangent_x);
  const double y = camera.down.dot(from) / (depth * camera.tangent_y);
  return {.x = 0.5 * (1.0 + x) * width, .y = 0.5 * (1.0 + y) * height, .depth = depth};
}

}  // namespace tact::scenes

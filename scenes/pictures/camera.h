// Where a picture is taken from.
#pragma once

#include <Eigen/Core>

#include "engine/base/box.h"
#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

// A perspective camera. The vectors are orthonormal; right x down points forward.
struct Camera {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres
  Eigen::Vector3d forward = -Eigen::Vector3d::UnitZ();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d down = -Eigen::Vector3d::UnitY();
  double tangent_x = 1.0;  // tangent of half the angle of view, across and down
  double tangent_y = 1.0;
  double focus =
      1.0;  // distance to the middle of what is shown, metres; marks and soft shadows take their size from it
};

// From which side, and how much room is left around what is shown.
struct View {
  double azimuth = 32.0;        // degrees around the up axis; 0: from the front (+z if y is up, -y if z is up)
  double elevation = 22.0;      // degrees above the horizon, -89 to 89
  double angle_of_view = 30.0;  // degrees along the diagonal of the picture, 1 to 120
  double margin = 0.1;          // share of the picture's half that stays free at each side, 0 to 0.9
};

// The camera that looks along `view`, as near as all `points` (3 x N, metres) stay inside a picture of this size with
// the margin. Without points it shows the unit box around the origin; points without extent are given some room.
Camera framing(const Eigen::Matrix3Xd& points, UpAxis up, int width, int height, const View& view = {});
// The same for the corners of a box. One camera for the union of the boxes of all frames keeps a film still.
Camera framing(const base::Box& box, UpAxis up, int width, int height, const View& view = {});

// A point in pixels from the picture's top left corner; its depth is the distance along `forward`, metres.
struct PicturePoint {
  double x = 0.0;
  double y = 0.0;
  double depth = 0.0;
};

// Where `point` is seen; it must lie in front of the camera (depth > 0) for x and y to have a meaning.
PicturePoint project(const Camera& camera, const Eigen::Vector3d& point, int width, int height);

}  // namespace tact::scenes

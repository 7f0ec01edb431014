// A scene made ready for rays: coordinates in floats around the middle of the picture, colours as light, normals for
// smooth shading, marks as meshes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scenes/pictures/camera.h"
#include "scenes/pictures/picture_scene.h"
#include "scenes/pictures/ray_scene.h"

namespace tact::scenes {

// Light or reflectance, linear, a channel each of red, green and blue.
using Light = Eigen::Vector3f;

Light linear(Color color);
Color displayed(const Light& light);

struct DrawnMesh {
  Eigen::Matrix3Xf positions;
  Eigen::Matrix3Xi facets;
  Eigen::Matrix3Xf corner_normals;  // 3 x 3F; empty: flat
  Light reflectance = Light::Zero();
  float opacity = 1.0f;         // where nothing hides it
  float hidden_opacity = 0.0f;  // of a mark, where a body hides it
  bool edges = false;           // draw the edges of its facets
};

struct DrawnLayer {
  std::vector<DrawnMesh> meshes;  // by RayHit::mesh
  RayScene rays;
};

// One unit of length is half the height of the picture at the camera's focus; the origin is the point in focus.
struct DrawnScene {
  Eigen::Vector3f eye;
  Eigen::Vector3f forward;
  Eigen::Vector3f right;  // scaled by the tangent of half the angle of view
  Eigen::Vector3f down;   // likewise
  Eigen::Vector3f up;
  std::optional<float> ground;
  DrawnLayer bodies;
  RayScene blockers;                                 // the opaque bodies, which cast shadows
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();  // of a ball around the opaque bodies
  float radius = 0.0f;                               // of that ball
  std::vector<DrawnLayer> marks;                     // each layer is drawn over the one before
};

DrawnScene drawn_scene(const PictureScene& scene, const Camera& camera, int threads);

}  // namespace tact::scenes

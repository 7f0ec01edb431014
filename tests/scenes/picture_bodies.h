// Small bodies for pictures and exports.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>

#include "scenes/pictures/picture_scene.h"

namespace tact::tests {

// A closed cube with the corner (0, 0, 0) moved to `lower`.
inline scenes::PictureBody cube(const Eigen::Vector3d& lower, double edge, scenes::Color color,
                                std::string name = "cube") {
  scenes::PictureBody body;
  body.name = std::move(name);
  body.color = color;
  body.positions.resize(3, 8);
  for (int i = 0; i < 8; ++i) body.positions.col(i) = lower + edge * Eigen::Vector3d(i & 1, i >> 1 & 1, i >> 2 & 1);
  body.facets.resize(3, 12);
  body.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,             //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return body;
}

// Two cubes that overlap, above a floor.
inline scenes::PictureScene two_cubes() {
  scenes::PictureScene scene;
  scene.bodies.push_back(cube({0.0, 0.0, 0.0}, 1.0, scenes::body_color(0), "left"));
  scene.bodies.push_back(cube({0.6, 0.3, 0.4}, 1.0, scenes::body_color(1), "right"));
  scene.ground = 0.0;
  return scene;
}

}  // namespace tact::tests

// Ropes and grains as pictures show them: with a surface around them.
#pragma once

#include <Eigen/Core>
#include <span>

#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

// Adds tubes around edges and balls around vertices, of this radius in metres, to what a body shows. Its vertices stay
// the first ones.
void add_thick_lines(const Eigen::Matrix2Xi& edges, std::span<const int> grains, double radius, PictureBody& body);

}  // namespace tact::scenes

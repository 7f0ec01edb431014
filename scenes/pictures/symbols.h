// Arrows and rings as triangle meshes.
#pragma once

#include <Eigen/Core>

#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

struct SymbolMesh {
  Eigen::Matrix3Xd positions;
  Eigen::Matrix3Xi facets;
};

// A shaft and a head, closed; `thickness` is the shaft's radius in metres. An arrow shorter than its head is all head.
SymbolMesh arrow_mesh(const Arrow& arrow, double thickness);
// The rim of the disk as a tube of radius `thickness`, metres.
SymbolMesh ring_mesh(const Disk& disk, double thickness);
// The disk itself, flat.
SymbolMesh disk_mesh(const Disk& disk);

}  // namespace tact::scenes

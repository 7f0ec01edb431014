// What a picture shows: bodies, a ground, marks for contacts, words. Plain data: the renderer reads it, whoever has
// something to show fills it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/box.h"
#include "scenes/pictures/picture.h"

namespace tact::scenes {

enum class Shading {
  smooth,  // normals are blended across facets that meet at less than 50 degrees; sharper edges stay sharp
  flat,    // each facet has its own normal
};

// Both sides of a facet are shown; the colour of the inner side is a little darker.
struct PictureBody {
  std::string name;            // for files that hold names; not drawn
  Eigen::Matrix3Xd positions;  // 3 x V, metres, finite
  Eigen::Matrix3Xi facets;     // 3 x F
  Color color;
  Shading shading = Shading::smooth;
  double opacity = 1.0;             // below 1: seen through, casts no shadow
  std::vector<int> meeting_facets;  // facets to mark
};

struct Arrow {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();       // metres
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // unit
  double length = 0.0;                                   // metres; nothing is drawn for a length that is not positive
  Color color = kDirectionColor;
};

struct Disk {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // metres
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit
  double radius = 0.0;                                // metres; nothing is drawn for a radius that is not positive
  Color color = kZoneColor;
};

enum class UpAxis { y, z };

struct PictureScene {
  std::vector<PictureBody> bodies;
  UpAxis up = UpAxis::y;
  std::optional<double> ground;  // height of a floor that catches shadows, metres along the up axis
  std::vector<Arrow> arrows;
  std::vector<Disk> disks;
  bool facets_shine = true;  // meeting facets shine through the bodies that hide them
  std::string title;         // top left; empty: none
  std::string caption;       // bottom left; empty: none
};

inline Eigen::Vector3d up_vector(UpAxis up) {
  return up == UpAxis::y ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
}

// The corners of all facets, the ends of all arrows and points of the rims of all disks, 3 x N: what a picture of this
// scene alone should hold.
Eigen::Matrix3Xd shown_points(const PictureScene& scene);
// The box around the corners of all facets, without the marks; empty if there are none.
base::Box bounding_box(const PictureScene& scene);

}  // namespace tact::scenes

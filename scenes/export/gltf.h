// A run as one animated glTF 2.0 file (.glb) for Blender and viewers on the web.
#pragma once

#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

// Collects frames and writes them together. A body that moves has a morph target a frame after the first, which the
// animation switches on in turn; one that never moves is stored once. Positions become floats, 12 bytes a vertex that
// moves and frame, kept in memory until the file is written; the weights of n frames take 4 n² bytes once. glTF is y up
// and in metres: scenes that are z up are turned by their root node. Viewers make the normals.
class GltfAnimation {
 public:
  explicit GltfAnimation(UpAxis up) : up_(up) {}

  // `time` in seconds, later than that of the frame before. Every frame holds the bodies of the first, with their
  // numbers of vertices; names, facets and colours are those of the first.
  // Errors: std::runtime_error if the time or the bodies do not fit the frames before.
  void add_frame(std::span<const PictureBody> bodies, double time);

  int frames() const { return static_cast<int>(times_.size()); }

  // Writes the file; whether `out` took all is for its owner to ask. Errors: std::runtime_error if there is no frame,
  // or if the file would pass the format's limit of 4 GiB.
  void write(std::ostream& out) const;

 private:
  struct Body {
    std::string name;
    Color color;
    double opacity = 1.0;
    Eigen::Matrix3Xi facets;
    std::vector<Eigen::Matrix3Xf> positions;  // a frame each; only the first if the body has not moved so far
  };
  class Writer;

  UpAxis up_;
  std::vector<float> times_;
  std::vector<Body> bodies_;
};

}  // namespace tact::scenes

// Frames for ParaView: a file of polygons (.vtp) a frame and one index of all frames (.pvd) to open.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

// Writes NAME.pvd and NAME_00000.vtp, NAME_00001.vtp, ... into a folder. Positions are doubles, bit for bit; metres.
// Each facet carries `body`, its body's number, `facet`, its own number in that body, and `meeting`, 1 if it is marked
// as meeting another. Facets keep their order, body by body. The index is written anew after every frame, so that it is
// right whenever the run ends.
class VtkSeries {
 public:
  // Creates the folder. Errors: FileError.
  VtkSeries(std::filesystem::path folder, std::string name);

  // `time` in seconds. Errors: FileError.
  void write(std::span<const PictureBody> bodies, double time);

  // The file to open.
  std::filesystem::path index_file() const;

 private:
  void write_index() const;

  std::filesystem::path folder_;
  std::string name_;
  std::vector<double> times_;
};

}  // namespace tact::scenes

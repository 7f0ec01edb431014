// Frames for ParaView: a file of polygons (.vtp) a frame and one index of all frames (.pvd) to open.
#pragma once

#include <tact/report.h>
#include <tact/world.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

// What was found at a body's surface, as attributes of its files.
struct SurfaceFields {
  std::vector<double> gap;  // of each vertex the least gap of its contact points, metres; NaN where there is none
  std::vector<int> crossing = {};  // the facets that meet another, ascending
};

// Those of each body. Without contact points all gaps are NaN.
std::vector<SurfaceFields> surface_fields(const Report& report, const World& world, const std::vector<BodyId>& bodies);

// Writes NAME.pvd and NAME_00000.vtp, NAME_00001.vtp, ... into a folder. Positions are doubles, bit for bit; metres.
// Each vertex and facet carries `body`, its body's number; each facet `facet`, its own number in that body, and
// `tact_crossing`, 1 if it is marked as meeting another; each vertex `tact_gap`, where fields are given. Facets keep
// their order, body by body. The index is written anew after every frame, so that it is right whenever the run ends.
// The program reads such a series as the bodies that it was written from.
class VtkSeries {
 public:
  // Creates the folder. Errors: FileError.
  VtkSeries(std::filesystem::path folder, std::string name);

  // `time` in seconds; `fields` are those of the bodies, or none. Errors: FileError.
  void write(std::span<const PictureBody> bodies, double time, std::span<const SurfaceFields> fields = {});

  // The file to open.
  std::filesystem::path index_file() const;

 private:
  void write_index() const;

  std::filesystem::path folder_;
  std::string name_;
  std::vector<double> times_;
};

}  // namespace tact::scenes

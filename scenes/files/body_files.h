// Bodies from mesh files and folders of them.
#pragma once

#include <tact/body.h>

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scenes/files/file_error.h"

namespace tact::scenes {

// What became of vertices with equal positions.
struct Weld {
  int merged_vertices = 0;   // with an earlier one
  int collapsed_facets = 0;  // which have a vertex twice that had three
};

// A body as files give it: one mesh file stands still, a folder or a series (.pvd) moves, a file a frame.
struct BodyFrames {
  std::string name;  // of the file, folder or series; "#2", "#3" ... after it if it comes again, ":3" for body 3 of it
  std::string short_name = {};                    // the same without the ending of the file
  std::vector<std::filesystem::path> files = {};  // one a frame
  std::vector<Eigen::Matrix3Xd> positions = {};   // 3 x V, metres, one a frame
  Eigen::Matrix3Xi facets = {};                   // 3 x F, the same in all frames
  std::vector<int> vertices = {};                 // the number of each vertex in the files; empty: its own
  Surface surface = Surface::closed;
  bool moves = false;              // a folder, or a series of several frames
  std::vector<double> times = {};  // of the frames of a series, seconds; else empty
  double margin = 0.0;             // metres
  bool self_contact = false;
  Weld weld = {};                          // of weld_frames()
  std::vector<std::string> warnings = {};  // of its files, a line each; of many the first few
};

// Is told that `done` of `all` files are read: before the first one, and after each.
using ReadProgress = std::function<void(int done, int all)>;

// The bodies of `paths`, in their order; a file or series that tells of several bodies gives them all, by their
// numbers. Of a folder the mesh files are taken, in the order of their names, numbers in them by their value, up to
// `most_frames` of them; other files, and those whose names begin with a dot, are ignored. Each part of a series is a
// body. All frames are held: 24 bytes a vertex and frame. Errors: FileError, also for a folder without a mesh file,
// frames of different topology and folders with different numbers of files.
std::vector<BodyFrames> read_bodies(
    const std::vector<std::filesystem::path>& paths, int most_frames = std::numeric_limits<int>::max(),
    const ReadProgress& progress = [](int, int) {});

// How many frames the folders among `bodies` hold; 0 if none of them moves.
int frame_count(const std::vector<BodyFrames>& bodies);
// The times of the frames, of the first series among `bodies`; empty if there is none.
std::vector<double> times_of(const std::vector<BodyFrames>& bodies);

}  // namespace tact::scenes

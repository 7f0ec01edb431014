// A run as one HTML file that plays it: no server, no network. The page itself is that of viewer/, a part of the
// program.
#pragma once

#include <tact/tact.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "scenes/commands/interrupt.h"
#include "scenes/files/output_file.h"
#include "scenes/view/viewed_body.h"

namespace tact::scenes {

struct ViewOptions {
  std::string file = {};                     // the page to write; empty: none
  int every = 1;                             // steps from one that is shown to the next
  int from = 0;                              // the first step that is shown
  int to = std::numeric_limits<int>::max();  // the last one
  bool few_points = false;                   // of each patch at most four contact points
  int largest = 400;                         // megabytes that the page may have: browsers hold some hundred
};

// What the page says it shows.
struct ViewTitle {
  std::string name;  // of a scene or a file
  std::string kind;  // "scene", "recording" or "meshes"
};

// Looks at the world after each step, and writes as it goes: memory holds three positions a vertex and a chunk of
// steps.
class ViewPage {
 public:
  // Opens the file. Errors: FileError.
  ViewPage(const ViewOptions& options, ViewTitle title, std::ostream& standard_output);

  // How opaque bodies are at first, 0: hidden, in the order in which they are added; 1 if not given.
  void set_opacities(std::vector<double> opacities) { opacities_ = std::move(opacities); }

  // The step that `report` tells of, shown or not; steps ascend. `time`: seconds, of a simulation. Errors: FileError if
  // the page becomes larger than it may be.
  void add_step(int step, std::optional<double> time, const World& world, const Report& report);
  // Ends the page. Errors: FileError if it could not be written, or shows no step.
  void finish(Ending ending);

  // "FILE: 300 steps, 12.3 MB".
  std::string summary() const;

 private:
  // Of the steps that are shown, an entry each.
  struct Columns {
    std::vector<int> step;
    std::vector<std::optional<double>> time;
    std::vector<std::string> hash;
    std::vector<std::int64_t> points;
    std::vector<std::optional<double>> least_gap;  // of all points, metres
    std::vector<StepStats> stats;
  };
  struct Chunk {
    int first = 0;  // frame
    int count = 0;
    std::int64_t bytes = 0;
  };
  // The clusters of a body from a frame on.
  struct Grouping {
    std::size_t body = 0;
    int frame = 0;
    std::vector<int> clusters;
  };

  bool shows(int step) const;
  void follow_bodies(const World& world);
  void add_body(const World& world, BodyId id, double opacity);
  std::size_t place_of(BodyId id) const { return place_of_slot_[id.index]; }
  void note_clusters(const Report& report, bool all);
  void write_frame(const Report& report);
  void end_chunk();
  void write_meshes();
  void write_head(Ending ending);
  void check_size() const;
  int frames() const { return static_cast<int>(columns_.step.size()); }

  ViewOptions options_;
  ViewTitle title_;
  OutputFile file_;
  std::int64_t written_ = 0;  // bytes
  std::vector<ViewedBody> bodies_;
  std::vector<std::size_t> place_of_slot_;  // in bodies_, by BodyId::index
  Columns columns_;
  ViewBytes chunk_;
  std::vector<Chunk> chunks_;
  std::vector<Grouping> groupings_;
  std::vector<double> opacities_;
  Eigen::Matrix3Xd positions_;  // scratch
  StepStats sums_;              // of all steps, shown or not
  int steps_ = 0;
  Settings settings_;
};

}  // namespace tact::scenes

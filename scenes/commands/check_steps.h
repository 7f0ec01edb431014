// What `tact check` and tact.check() of Python share: bodies from files in a world, frame by frame.
#pragma once

#include <tact/motion.h>
#include <tact/report.h>
#include <tact/world.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/files/body_files.h"

namespace tact::scenes {

// What is said of bodies by their names, with the ending of the file or without where only one has the name.
struct BodyOptions {
  std::vector<std::string> sheets = {};                            // these are sheets, the others closed
  std::optional<double> margin = {};                               // of all bodies, metres
  std::vector<std::pair<std::string, double>> margins = {};        // of those named, metres
  std::vector<std::string> selves = {};                            // held against themselves; "all": every one
  std::vector<std::pair<std::string, std::string>> excluded = {};  // not held against each other
};

// What messages call the options.
struct BodyOptionNames {
  const char* sheet = "--sheet";
  const char* margin = "--margin";
  const char* self = "--self";
  const char* exclude = "--exclude";
};

// The places of two bodies that are not held against each other.
using ExcludedPair = std::pair<std::size_t, std::size_t>;

// Sets what `options` say in `bodies`. Errors: UsageError, for a name that is no body's or several ones', and for a
// body excluded from itself.
std::vector<ExcludedPair> apply_body_options(const BodyOptions& options, std::vector<BodyFrames>& bodies,
                                             const BodyOptionNames& names = {});

// What a frame gives; `motion` is null where impacts are not requested, and in the first frame.
struct CheckedFrame {
  const Report& report;
  const MotionReport* motion;
};

// Bodies in a world that is stepped through their frames. Errors name the file of the frame.
class CheckSteps {
 public:
  // Adds the bodies to `world`, which must outlive this. Errors: FileError.
  CheckSteps(std::vector<BodyFrames> bodies, const std::vector<ExcludedPair>& excluded, World& world);

  // Steps the world to frame number `frame`; frames ascend from 0. Errors: FileError.
  CheckedFrame step(int frame, bool impacts);
  // The file of each body in the frame, if one of them moves.
  std::vector<std::string> files_of(int frame) const;
  const std::vector<BodyFrames>& bodies() const { return bodies_; }
  const std::vector<BodyId>& ids() const { return ids_; }
  // What was welded of each body, which weld_frames() has done.
  std::vector<Weld> welds() const;

 private:
  void set_frame(int frame);

  std::vector<BodyFrames> bodies_;
  std::vector<BodyId> ids_;
  World& world_;
};

// "cloth, ball.obj"
std::string names_of(const std::vector<BodyFrames>& bodies);

}  // namespace tact::scenes

// The world that the engine's tests use: it keeps what entered it, and where a test fails its input is a file that
// `tact replay` runs again.
#pragma once

#include <tact/recording.h>
#include <tact/tact.h>

#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "engine/world_tuning.h"

namespace tact::tests {

// A world that keeps its recording. When the first assertion of a test fails, the recordings of the few worlds
// that made the test's last steps are written to the folder failed_tests of the build, and their paths printed.
class RecordedWorld : public tact::World {
 public:
  explicit RecordedWorld(const Settings& settings = {});

  const Report& detect();
  // Is no part of a recording, as no answer depends on it.
  void set_tuning(const base::Tuning& tuning) { WorldTuning::set(*this, tuning); }

  // The recording so far, see tact/recording.h; empty if it grew too long.
  std::string recording() const { return recording_->str(); }

 private:
  std::shared_ptr<std::ostringstream> recording_;
  std::unique_ptr<Recorder> recorder_;
};

// Writes the recordings of the worlds that made the last steps of this test, named after it, and returns the paths.
// A test that fails does it by itself.
std::vector<std::filesystem::path> write_recordings(const std::filesystem::path& folder);

}  // namespace tact::tests

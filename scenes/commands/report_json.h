// Reports as JSON, of `tact check`, `tact run` and `tact view` alike. docs/pages/json.md tells the form, and a test
// holds it against what is written.
#pragma once

#include <tact/motion.h>
#include <tact/report.h>
#include <tact/settings.h>
#include <tact/world.h>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "scenes/commands/interrupt.h"
#include "scenes/files/body_files.h"

namespace tact::scenes {

// "hulls", "paper" or "exact"; "closed" or "sheet"; "carried", "fresh" or "smallest".
std::string accuracy_name(Accuracy accuracy);
std::string surface_name(Surface surface);
std::string direction_source_name(DirectionSource source);
// "vertex-facet", say: the name of the value with a hyphen.
std::string feature_pair_name(FeaturePair kind);
// The hash of `report` as 16 hexadecimal digits.
std::string hash_text(const Report& report);

// Writes frame by frame, a line each, so that a long run takes no memory.
class JsonReport {
 public:
  enum class Outcomes { none, counts };    // what became of facets, which takes longer than to find the pairs
  enum class Surfaces { taken, checked };  // whether bodies have a "check": see surface_report.h

  // Writes what comes before the frames. `world` must hold all the bodies of the run, in its settings the number of
  // threads that is to be told. `welds` are those of the bodies, or none. `out` must outlive the report.
  JsonReport(std::ostream& out, const World& world, Outcomes outcomes = Outcomes::none,
             Surfaces surfaces = Surfaces::taken, const std::vector<Weld>& welds = {});
  // `motion` is what met since the frame before, or null; `files` are those of the bodies, or none; `time` in seconds.
  void add_frame(int frame, const Report& report, const MotionReport* motion = nullptr,
                 const std::vector<std::string>& files = {}, std::optional<double> time = {});
  // Writes what comes after the frames.
  void finish(Ending ending = Ending::complete);

 private:
  std::ostream& out_;
  bool has_facets_;
  bool has_points_;
  bool has_curves_;
  bool has_within_reach_;
  Outcomes outcomes_;
  bool first_ = true;
};

}  // namespace tact::scenes

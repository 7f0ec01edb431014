// Reports as JSON, of `tact check` and `tact run` alike:
//
//   {"tact":"<version>","accuracy":"exact","threads":2,
//    "bodies":[{"name":"spot.ply","vertices":2930,"facets":5856,"surface":"closed"},...],
//    "frames":[{"frame":0,"hash":"<16 hexadecimal digits>",
//      "pairs":[{"a":0,"b":1,"hulls_overlap":true,"direction":[x,y,z],"depth":d,
//                "source":"carried","iterations":k,"limit_reached":false,"kept_facets":[ka,kb],
//                "outcomes":[{"outside_box":n,...,"meets":n},{...}],"facet_pairs":[[fa,fb],...]},...],
//      "stats":{"bodies":2,...},"times_ms":{"refresh":0.1,...},
//      "impacts":[{"bodies":[0,1],"kind":"edge-edge","a":[1,2],"b":[7,9],"time":t},...],"first_time":t,
//      "time":0.5,"files":["cloth/frame_2.obj","ball.obj"]}],
//    "interrupted":true}
//
// `a` and `b` are places in `bodies`. `pairs` are the candidate pairs, sorted by (a, b); one whose hulls are apart has
// only "hulls_overlap":false and an empty "facet_pairs". "source" tells how the direction was found: "carried", "fresh"
// or "smallest"; "outcomes" how many facets of each body had each FacetOutcome, where they were requested;
// "limit_reached" whether it is only the best that was found before a limit. At Accuracy::hulls every "facet_pairs" is
// null. `stats` and `times_ms` have the names of <tact/statistics.h>, the times without their "_ms". `impacts` are
// those since the frame before, sorted by bodies and then by time, where they are requested; `first_time` is null if
// there is none. `files` names the file of each body, where a folder moves one, and `time` is that of the frame in a
// series, seconds. A body of `tact check --weld` tells
// how many vertices merged with an earlier one, "merged_vertices", and "collapsed_facets"; one of `--surfaces` has its
// "check", see surface_report.h. A body with itself has `a` equal to `b` and facet pairs; where points are requested
// "point_limit_reached" tells whether some are missing. A pair has "points", of which each says whether it is a minimum
// of both surfaces, "patches" and "curves" where these are requested; a curve has its "points" in order, whether it is
// "closed", and the "facets" between them: [{"closed":true,"points":[[x,y,z],...],"facets":[[fa,fb],...]},...].
// `interrupted` is there only if Ctrl-C ended the frames. Numbers
// read back to the same double; ids of patches, which may be no double, are 16 hexadecimal digits. A name that is not
// UTF-8 has U+FFFD in the place of each wrong byte.
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

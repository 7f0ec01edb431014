// Everything that `tact run` writes besides its table.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "scenes/commands/failures.h"
#include "scenes/commands/interrupt.h"
#include "scenes/commands/report_json.h"
#include "scenes/export/chrome_trace.h"
#include "scenes/export/gltf.h"
#include "scenes/export/vtk.h"
#include "scenes/files/output_file.h"
#include "scenes/library/scene.h"
#include "scenes/pictures/scene_pictures.h"
#include "scenes/view/view_page.h"

namespace tact::scenes {

struct OutputOptions {
  bool pictures = true;
  std::filesystem::path out = {};  // the folder for pictures; empty: tact-<scene> in the working folder
  int every = 0;                   // steps from one frame to the next, in pictures, gltf and vtk; 0: 60 frames a second
  bool zones = false;              // show impact zones in pictures and in the page
  bool points = false;             // and contact points in the page
  std::string json = {};           // the report of every step, "-" for standard output; empty: none
  std::string contacts = {};       // the contacts of every step, a line each, "-" likewise
  std::string states = {};         // how every step went, a line each, "-" likewise
  std::string trace = {};          // a Chrome trace of every step; empty: none
  std::filesystem::path gltf = {};  // a .glb file; empty: none
  std::filesystem::path vtk = {};   // a folder; empty: none
  ViewOptions view = {};            // a page that plays the run
};

// The bodies that no picture shows are not in the files for other programs either.
class RunOutputs {
 public:
  // Opens reports, contacts, states, trace and animation and makes the folders, so that a run does not begin for which
  // one of them cannot be. `scene` without its bodies; `title` is its name. Errors: FileError; std::runtime_error if
  // the font is missing.
  RunOutputs(const OutputOptions& options, const std::string& title, const Scene& scene, const World& world,
             int threads, std::ostream& out);

  // What step number `step`, from 0, gives. Errors: FileError.
  void add_step(int step, const Simulation& simulation);
  // Ends all files; makes the contact sheet and the film. Each is tried, also after others failed.
  void finish(Ending ending, Failures& failures);
  // Says where everything is that could be made.
  void print(std::ostream& out) const;

 private:
  void add_frame(const Simulation& simulation);
  void finish_pictures(Failures& failures);
  std::vector<PictureBody> visible_bodies(const Simulation& simulation) const;

  OutputOptions options_;
  std::vector<Look> looks_;
  int every_;
  std::optional<ScenePictures> pictures_;
  std::optional<OutputFile> json_file_;
  std::optional<JsonReport> json_;
  std::optional<OutputFile> contacts_;
  std::optional<OutputFile> states_;
  std::optional<OutputFile> trace_file_;
  std::optional<ChromeTrace> trace_;
  std::optional<OutputFile> gltf_file_;
  std::optional<GltfAnimation> gltf_;
  std::optional<VtkSeries> vtk_;
  std::optional<ViewPage> page_;
  std::vector<std::string> made_;  // lines that say where things are, or why there is no film
};

}  // namespace tact::scenes

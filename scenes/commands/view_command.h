// `tact view`: a page that plays a recording, mesh files or a scene.
#pragma once

#include <tact/settings.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "scenes/commands/check_command.h"
#include "scenes/view/view_page.h"

namespace tact::scenes {

struct ViewCommandOptions {
  bool opens = false;  // shows the page, with xdg-open
  // One recording; or mesh files and folders of them; or the name of a scene, if there is no file of that name.
  std::vector<std::string> what = {};
  ViewOptions page = {};                // file: tact-NAME.html in the working folder, if empty
  CheckOptions check = {};              // of meshes: sheets, margins, selves
  int frames = 0;                       // of a scene or of meshes; 0: 300, or all
  int size = 0;                         // of a scene; 0: its own
  bool continuous = false;              // of a scene
  Outputs outputs = {};                 // zones, patches and points; of a recording besides those that it has
  Accuracy accuracy = Accuracy::exact;  // not of a recording
  std::optional<int> threads = {};  // 0: as many as OpenMP would use; nothing: that, or as many as the recording had
  std::string json = {};            // the report besides, "-" for standard output; empty: none
};

// Writes the page and says so on `out`. Errors: UsageError, FileError (a recording that is none or was cut: with the
// byte; a page that would be too large), Error.
void view(const ViewCommandOptions& options, std::ostream& out);

// Adds the subcommand `view` to `program`; to parse it is to run it.
void add_view_command(CLI::App& program);
// The page that is written where no other is named: tact-NAME.html.
std::string page_of(const std::string& name);
// --from, --to, --few-points and --largest, of a page.
void add_page_options(CLI::App& command, ViewOptions& page);
// Errors: UsageError.
void check_page_options(const ViewOptions& page);

}  // namespace tact::scenes

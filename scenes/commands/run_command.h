// `tact run`: a scene, simulated, with pictures.
#pragma once

#include <tact/settings.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <ostream>
#include <string>

#include "scenes/commands/run_outputs.h"

namespace tact::scenes {

struct RunOptions {
  std::string scene;  // a name of the catalog
  int frames = 300;   // steps of the simulation
  int size = 0;       // 0: the scene's own
  Accuracy accuracy = Accuracy::exact;
  int threads = 0;          // 0: as many as OpenMP would use
  bool continuous = false;  // stop bodies before they meet
  std::string record = {};  // the file to record what enters the engine; empty: none
  OutputOptions outputs = {};
  enum class Prints { all, files } prints = Prints::all;  // besides where files are, what the run added up to
};

// Runs the scene and prints what the run adds up to to `out`, or to nobody if JSON goes there. SIGINT ends it with what
// was done so far. Errors: UsageError (no such scene, a size that it does not have, two outputs in one file),
// FileError, Error; FileError for what could not be ended comes after all is printed.
void run(const RunOptions& options, std::ostream& out);

// Adds the subcommand `run` to `program`; to parse it is to run it.
void add_run_command(CLI::App& program);

}  // namespace tact::scenes

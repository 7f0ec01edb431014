// `tact check`: which of the bodies given as mesh files touch, frame by frame.
#pragma once

#include <tact/settings.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "scenes/view/view_page.h"

namespace tact::scenes {

struct CheckOptions {
  std::vector<std::filesystem::path> meshes = {};  // files that stand still; folders and series that move
  std::vector<std::string> sheets = {};            // names of the bodies that are sheets, the others being closed
  std::vector<std::string> margins = {};           // "M" for every body, "NAME=M" for one, metres; the last one counts
  std::vector<std::string> selves = {};            // bodies that are held against themselves; "all": every one
  std::vector<std::pair<std::string, std::string>> excluded = {};  // bodies that are not held against each other
  Outputs outputs = {};                                            // points; for the page also zones and patches
  bool impacts = false;                                            // what meets between a frame and the next
  bool weld = false;                                               // vertices with equal positions are one
  bool surfaces = false;                                           // what each surface is, before the first frame
  Accuracy accuracy = Accuracy::exact;
  int threads = 0;                 // 0: as many as OpenMP would use
  int frames = 0;                  // of folders the first so many; without a folder the number of steps; 0: all, or one
  std::string json = {};           // the file to write, "-" for standard output; empty: none
  std::filesystem::path vtk = {};  // the folder for frames for ParaView; empty: none
  std::string record = {};         // the file to record what enters the engine; empty: none
  ViewOptions view = {};           // a page that plays the frames
  bool table = true;               // print what touches
};

// Reads all files first, so that nothing is written if one is bad; then steps one world through the frames. What was
// read all the same, though it is odd, is a warning on standard error. Without
// "-" for JSON, tables go to `out`. SIGINT ends it after the frame. Errors: FileError, UsageError (a name that is no
// body, an output that is a mesh or another output), Error.
void check(const CheckOptions& options, std::ostream& out);

// Adds the subcommand `check` to `program`; to parse it is to run it.
void add_check_command(CLI::App& program);

}  // namespace tact::scenes

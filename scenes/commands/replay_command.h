// `tact replay`: a recording, run again and compared.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <optional>
#include <ostream>

namespace tact::scenes {

struct ReplayOptions {
  std::filesystem::path recording = {};
  std::optional<int> threads = {};  // 0: as many as OpenMP would use; nothing: as many as the recording had
};

// Runs the recording again; to `out` go a line for each step whose hash differs and one about the whole. SIGINT ends it
// after the step. Errors: FileError, for a file that is no whole recording, with the byte, and after the last step for
// the first one whose hash differs; Error.
void replay(const ReplayOptions& options, std::ostream& out);

// Adds the subcommand `replay` to `program`; to parse it is to run it.
void add_replay_command(CLI::App& program);

}  // namespace tact::scenes

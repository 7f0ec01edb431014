// `tact scenes`: which scenes there are.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <ostream>

namespace tact::scenes {

// Prints a line a scene: its name, what is to be seen, its sizes.
void list_scenes(std::ostream& out);

// Adds the subcommand `scenes` to `program`; to parse it is to run it.
void add_scenes_command(CLI::App& program);

}  // namespace tact::scenes

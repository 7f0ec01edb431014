// The command line program `tact`.
#pragma once

namespace tact::scenes {

// Runs the command that `argv` names and returns the program's exit status: 0 done; 1 the input is bad, or a file or
// standard output did not take all, with one line on standard error; 2 wrong usage, with one line too.
int run_command_line(int argc, const char* const* argv);

}  // namespace tact::scenes

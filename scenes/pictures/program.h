// Other programs, run without a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tact::scenes {

struct ProgramResult {
  enum class End {
    success,  // it ended with status 0
    failure,  // it ended with another status, or by a signal
    missing,  // there is no such program
  };
  End end = End::missing;
  std::string output;  // the last lines that it wrote, to standard output and standard error
};

// Runs arguments[0], looked up in PATH, in `folder`, with nothing to read, and waits for its end. What it writes goes
// to the file `log`, which is removed afterwards. Errors: FileError if the log cannot be written; std::system_error if
// the system refuses to start a program that exists.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const std::filesystem::path& log);

}  // namespace tact::scenes

// Where a command writes: standard output or a file that must be written whole.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

namespace tact::scenes {

class OutputFile {
 public:
  // "-" is `standard_output`. Errors: FileError if the file cannot be opened.
  OutputFile(const std::string& path, std::ostream& standard_output);

  std::ostream& stream() { return *out_; }
  // Call it after the last write. Errors: FileError if not all of it was written.
  void finish();

 private:
  std::string name_;
  std::ofstream file_;
  std::ostream* out_;
};

}  // namespace tact::scenes

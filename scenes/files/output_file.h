// Where a command writes: standard output or a file that must be written whole.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

namespace tact::scenes {

// When a file can be seen under its name.
enum class Appears {
  whole,    // in finish(): until then it is NAME.<process>.part beside it, and an older file of its name stays
  at_once,  // with the first byte, and what was written stays whatever happens to the program
};

// A link, a device or a pipe appears at once, and so does a file in a folder that takes no new one.
class OutputFile {
 public:
  // "-" is `standard_output`. Errors: FileError if the file cannot be opened.
  OutputFile(const std::string& path, std::ostream& standard_output, Appears appears = Appears::whole);
  // Without finish(), nothing is left of a file that was to appear whole.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return *out_; }
  // Call it after the last write. Errors: FileError if not all of it was written.
  void finish();

 private:
  std::string name_;
  std::filesystem::path part_;  // empty: what is written goes to its place at once
  std::ofstream file_;
  std::ostream* out_;
};

}  // namespace tact::scenes

// The files that a command reads and writes, by the names that the user gave: no two of them may be one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tact::scenes {

class NamedFiles {
 public:
  void add_input(const std::filesystem::path& file);
  // The file that `option`, such as "--json", names; none if `file` is empty, "-", or no regular file, such as
  // /dev/null. Errors: UsageError if it is an input or another output, by whatever name.
  void add_output(const std::string& option, const std::filesystem::path& file);

 private:
  struct File {
    std::string option;  // empty: an input
    std::filesystem::path path;
  };
  std::vector<File> files_;
};

}  // namespace tact::scenes

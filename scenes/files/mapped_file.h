// A file's bytes without reading them all: for files that may be larger than memory.
#pragma once

#include <filesystem>
#include <string_view>

#include "scenes/files/file_error.h"

namespace tact::scenes {

// The bytes are the file's as long as nobody shortens it: reading past its new end then ends the program.
class MappedFile {
 public:
  // Errors: FileError for a file that cannot be opened or is not a regular one.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }

 private:
  std::string_view bytes_;
};

}  // namespace tact::scenes

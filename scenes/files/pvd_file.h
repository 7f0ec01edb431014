// ParaView's collections: the frames of bodies, by time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/file_error.h"

namespace tact::scenes {

// The frames of a part, by time.
struct PvdPart {
  std::vector<std::filesystem::path> files;  // as the collection names them, beside it
  std::vector<double> times;                 // seconds, ascending, one a file
};

// The parts of a collection in the order in which they first come up; all of them have the same times. `file` is its
// name, for messages and as the place of its files. Errors: FileError.
std::vector<PvdPart> parse_pvd(std::string_view bytes, const std::filesystem::path& file);

}  // namespace tact::scenes

// PNG files.
#pragma once

#include <filesystem>

#include "scenes/pictures/picture.h"

namespace tact::scenes {

// Writes `picture` as 8-bit RGB. Equal pictures give equal files: no time, no names inside. A file that could not be
// written whole is removed. Errors: FileError.
void write_png(const std::filesystem::path& file, const Picture& picture);

// Reads any PNG file; transparency is dropped. Errors: FileError.
Picture read_png(const std::filesystem::path& file);

}  // namespace tact::scenes

// What is wrong with a recording, as an error of its file.
#pragma once

#include <fmt/format.h>
#include <tact/error.h>

#include <cstddef>
#include <string>

#include "scenes/files/file_error.h"
#include "scenes/files/source.h"

namespace tact::scenes {

// Calls call(); Error bad_recording becomes a FileError that names `file`. Others pass.
template <class Call>
auto of_recording(const std::string& file, const Call& call) {
  try {
    return call();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_recording) throw;
    constexpr std::size_t kLongest = 300;
    throw FileError(fmt::format("{}: {}", file, printable(error.what(), kLongest)));  // it may hold the name of a body
  }
}

}  // namespace tact::scenes

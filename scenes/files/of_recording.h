// What is wrong with a recording, as an error of its file.
#pragma once

#include <fmt/format.h>
#include <tact/error.h>
#include <tact/recording.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "scenes/files/file_error.h"
#include "scenes/files/known_content.h"
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

// A player of the file of this name that holds `bytes`. Errors: FileError, for what is no recording; Error.
inline RecordingPlayer open_recording(std::string_view bytes, const std::string& file, const PlayOptions& options) {
  if (bytes.empty()) throw FileError(file + ": the file is empty");
  try {
    return of_recording(file, [&] { return RecordingPlayer(bytes, options); });
  } catch (const FileError&) {
    const std::optional<std::string> content = known_content(bytes);
    if (!content || bytes.starts_with("tactrec\n")) throw;
    throw FileError(fmt::format("{}: not a recording but {}", file, *content));
  }
}

}  // namespace tact::scenes

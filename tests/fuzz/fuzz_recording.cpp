// Any bytes are a recording that plays, or are refused in one line that names the file.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "scenes/files/recording_player.h"

namespace {

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

void check_message(const std::string& message) {
  require(message.starts_with("fuzzed:"), "a message names the file");
  require(message.size() < 1000, "a message is short");
  require(std::all_of(message.begin(), message.end(), [](char c) { return c >= 0x20 && c <= 0x7e; }),
          "a message is one printable line");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    tact::scenes::RecordingPlayer player(bytes, "fuzzed", 1);
    while (player.next()) {
    }
  } catch (const tact::scenes::FileError& error) {
    check_message(error.what());
  }
  return 0;
}

// Any bytes are a recording that plays, or are refused in a message that names the byte.
#include <tact/recording.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

void check_message(const std::string& message) { require(message.starts_with("byte "), "a message names the byte"); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    tact::RecordingPlayer player(bytes, {.threads = 1, .outputs = {}});
    while (player.next()) {
    }
  } catch (const tact::Error& error) {
    check_message(error.what());
  }
  return 0;
}

// Numbers in messages.
#pragma once

#include <charconv>
#include <string>

namespace tact::base {

// The fewest digits that read back to the same double.
inline std::string text_of(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace tact::base

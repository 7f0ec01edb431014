#include "scenes/files/source.h"

#include <fmt/format.h>

namespace tact::scenes {

void Source::set_item(std::string_view kind, std::int64_t index) {
  item_kind_ = kind;
  item_index_ = index;
}

void Source::fail(const std::string& message) const {
  const std::string item =
      item_kind_.empty() ? std::string() : fmt::format("{} {}: ", printable(item_kind_), item_index_);
  throw FileError(fmt::format("{}{}: {}{}", file_, place(), item, message));
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const std::string shown = byte < 0x20 || byte > 0x7e ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
    if (result.size() + shown.size() > longest) return result + "...";
    result += shown;
  }
  return result;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

}  // namespace tact::scenes

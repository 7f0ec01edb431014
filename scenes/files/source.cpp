#include "scenes/files/source.h"

#include <fmt/format.h>

#include "scenes/commands/counted.h"

namespace tact::scenes {

void Source::set_item(std::string_view kind, std::int64_t index) {
  item_kind_ = kind;
  item_index_ = index;
}

std::string Source::message_at(std::int64_t place, const std::string& message) const {
  const std::string item =
      item_kind_.empty() ? std::string() : fmt::format("{} {}: ", printable(item_kind_), item_index_);
  return fmt::format("{}{}: {}{}", file_, place_text(place), item, message);
}

void Source::fail_at(std::int64_t place, const std::string& message) const {
  throw FileError(message_at(place, message));
}

void Source::warn(const std::string& message) {
  constexpr std::size_t kKept = 3;
  ++warning_count_;
  if (warnings_.size() < kKept) warnings_.push_back(message_at(place(), message));
}

std::vector<std::string> Source::warnings() const {
  std::vector<std::string> all = warnings_;
  const std::int64_t left_out = warning_count_ - static_cast<std::int64_t>(warnings_.size());
  if (left_out > 0) all.push_back(fmt::format("{}: {} like these", file_, counted(left_out, "more warning")));
  return all;
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

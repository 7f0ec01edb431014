#include "scenes/files/xml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

std::string unescaped(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  std::string result;
  while (!text.empty()) {
    const auto entity =
        std::find_if(kEntities.begin(), kEntities.end(), [&](const auto& one) { return text.starts_with(one.first); });
    const bool found = entity != kEntities.end();
    result += found ? entity->second : text.front();
    text.remove_prefix(found ? entity->first.size() : 1);
  }
  return result;
}

void skip_blanks_of(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kXmlBlanks), text.size()));
}

}  // namespace

const std::string* XmlTag::attribute(std::string_view name_of_it) const {
  const auto found =
      std::find_if(attributes.begin(), attributes.end(), [&](const auto& one) { return one.first == name_of_it; });
  return found != attributes.end() ? &found->second : nullptr;
}

void XmlReader::advance(std::size_t to) {
  reached_ += std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(offset_),
                         bytes_.begin() + static_cast<std::ptrdiff_t>(to), '\n');
  offset_ = to;
  line_ = reached_;
}

void XmlReader::skip_past(std::string_view end) {
  const std::size_t at = bytes_.find(end, offset_);
  if (at == std::string_view::npos) fail(fmt::format("expected {}, found the end of the file", end));
  advance(at + end.size());
}

std::optional<XmlTag> XmlReader::next() {
  for (;;) {
    const std::size_t begin = bytes_.find('<', offset_);
    if (begin == std::string_view::npos) return std::nullopt;
    advance(begin);
    if (rest().starts_with("<!--")) {
      skip_past("-->");
    } else if (rest().starts_with("<?")) {
      skip_past("?>");
    } else if (rest().starts_with("<!")) {
      skip_past(">");
    } else {
      break;
    }
  }
  // A value may hold the mark that ends a tag.
  std::size_t end = offset_ + 1;
  for (char quote = '\0'; end < bytes_.size() && (quote != '\0' || bytes_[end] != '>'); ++end) {
    const char c = bytes_[end];
    if (quote != '\0' ? c == quote : c == '"' || c == '\'') quote = quote != '\0' ? '\0' : c;
  }
  if (end >= bytes_.size()) fail("a tag without its end, >");
  XmlTag tag = tag_of(bytes_.substr(offset_ + 1, end - offset_ - 1));
  advance(end + 1);
  return tag;
}

XmlTag XmlReader::tag_of(std::string_view inside) const {
  XmlTag tag{.line = line_};
  if (inside.starts_with('/')) {
    tag.kind = XmlTag::Kind::close;
    inside.remove_prefix(1);
  } else if (inside.ends_with('/')) {
    tag.kind = XmlTag::Kind::empty;
    inside.remove_suffix(1);
  }
  tag.name = inside.substr(0, inside.find_first_of(kXmlBlanks));
  inside.remove_prefix(tag.name.size());
  for (skip_blanks_of(inside); !inside.empty(); skip_blanks_of(inside)) {
    const std::size_t equals = inside.find('=');
    std::string_view name = inside.substr(0, std::min(equals, inside.find_first_of(kXmlBlanks)));
    inside.remove_prefix(std::min(equals, inside.size() - 1) + 1);
    skip_blanks_of(inside);
    const bool quoted = equals != std::string_view::npos && (inside.starts_with('"') || inside.starts_with('\''));
    const std::size_t end = quoted ? inside.find(inside.front(), 1) : std::string_view::npos;
    if (end == std::string_view::npos) fail(fmt::format("the attribute {} has no value in quotes", in_quotes(name)));
    tag.attributes.emplace_back(name, unescaped(inside.substr(1, end - 1)));
    inside.remove_prefix(end + 1);
  }
  return tag;
}

std::string_view XmlReader::text() const { return rest().substr(0, rest().find('<')); }

const std::string& XmlReader::required(const XmlTag& tag, std::string_view attribute) const {
  const std::string* const value = tag.attribute(attribute);
  if (value == nullptr) fail_at(tag.line, fmt::format("<{}> has no attribute {}", printable(tag.name), attribute));
  return *value;
}

std::int64_t XmlReader::count(const XmlTag& tag, std::string_view attribute) const {
  const std::string& value = required(tag, attribute);
  const std::optional<std::int64_t> number = parse_integer(value);
  if (!number || *number < 0 || *number > std::numeric_limits<int>::max())
    fail_at(tag.line, fmt::format("{} is {}, not 0 to 2147483647", attribute, in_quotes(value)));
  return *number;
}

}  // namespace tact::scenes

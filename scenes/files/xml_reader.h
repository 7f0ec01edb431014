// An XML file as its tags, one after the other: what the files of VTK need, which have no namespaces and no entities of
// their own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/files/source.h"

namespace tact::scenes {

struct XmlTag {
  enum class Kind { open, close, empty };  // <a>, </a>, <a/>
  Kind kind = Kind::open;
  std::string_view name = {};
  std::vector<std::pair<std::string_view, std::string>> attributes = {};
  std::int64_t line = 1;

  // The value of the attribute, or nothing.
  const std::string* attribute(std::string_view name_of_it) const;
};

class XmlReader final : public Source {
 public:
  XmlReader(std::string_view bytes, std::string file) : Source(bytes, std::move(file)) {}

  // The next tag; nothing at the end of the file. Comments and declarations are skipped. Fails if a tag has no end.
  std::optional<XmlTag> next();
  // What stands between the last tag and the next one.
  std::string_view text() const;
  // All after the last tag.
  std::string_view rest() const { return bytes_.substr(offset_); }
  // The value of an attribute; fails, for the tag's line, if there is none or it is no number of 0 to 2^31 - 1.
  const std::string& required(const XmlTag& tag, std::string_view attribute) const;
  std::int64_t count(const XmlTag& tag, std::string_view attribute) const;

  // Messages are about this line from here on.
  void set_place(std::int64_t line) { line_ = line; }
  std::int64_t place() const override { return line_; }

 private:
  std::string place_text(std::int64_t place) const override { return ":" + std::to_string(place); }
  // Goes on to byte `to`, and counts the lines.
  void advance(std::size_t to);
  // Goes on to the end of what is no tag, such as a comment.
  void skip_past(std::string_view end);
  XmlTag tag_of(std::string_view inside) const;

  std::size_t offset_ = 0;
  std::int64_t line_ = 1;
  std::int64_t reached_ = 1;  // the line of offset_
};

}  // namespace tact::scenes

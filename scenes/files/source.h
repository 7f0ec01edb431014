// A file's bytes and where a reader stands in them, so that every message names the place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/file_error.h"

namespace tact::scenes {

class Source {
 public:
  // `bytes` must outlive the source; `file` is the name that messages begin with.
  Source(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  // What is being read, such as vertex 7: messages name it until another is set. `kind` must outlive the source.
  void set_item(std::string_view kind, std::int64_t index);
  void clear_item() { item_kind_ = {}; }

  // The line or byte that is being read.
  virtual std::int64_t place() const = 0;
  // Throws FileError "<file><place>: <item>: <message>".
  [[noreturn]] void fail(const std::string& message) const { fail_at(place(), message); }
  // The same about what was read before, at `place`.
  [[noreturn]] void fail_at(std::int64_t place, const std::string& message) const;
  // Keeps a message of the same form about what is read all the same; of many the first few.
  void warn(const std::string& message);
  // The messages that were kept, and how many were not.
  std::vector<std::string> warnings() const;

 protected:
  // Such as ":12" for a line, ": byte 312" for a byte.
  virtual std::string place_text(std::int64_t place) const = 0;

  std::string_view bytes_;

 private:
  std::string message_at(std::int64_t place, const std::string& message) const;

  std::string file_;
  std::vector<std::string> warnings_;
  std::int64_t warning_count_ = 0;
  std::string_view item_kind_;
  std::int64_t item_index_ = 0;
};

// `text` made safe to print: what is not printable ASCII stands as \xNN, and what would be longer than `longest`
// characters is cut.
std::string printable(std::string_view text, std::size_t longest = 40);
// The same in quotes.
std::string in_quotes(std::string_view text);

}  // namespace tact::scenes

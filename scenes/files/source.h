// A file's bytes and where a reader stands in them, so that every message names the place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

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

  // Throws FileError "<file><place>: <item>: <message>".
  [[noreturn]] void fail(const std::string& message) const;

 protected:
  // Such as ":12" for a line, ": byte 312" for a byte.
  virtual std::string place() const = 0;

  std::string_view bytes_;

 private:
  std::string file_;
  std::string_view item_kind_;
  std::int64_t item_index_ = 0;
};

// `text` made safe to print: what is not printable ASCII stands as \xNN, and what would be longer than `longest`
// characters is cut.
std::string printable(std::string_view text, std::size_t longest = 40);
// The same in quotes.
std::string in_quotes(std::string_view text);

}  // namespace tact::scenes

// A text file as tokens, line by line. Lines end with \n, \r\n or \r; a byte-order mark of UTF-8 is skipped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scenes/files/source.h"

namespace tact::scenes {

struct TextSyntax {
  char comment = '\0';                 // it and all after it on the line is skipped; 0: none
  bool backslash_joins_lines = false;  // a backslash at the end of a line joins the next line to it
};

// The double nearest to `text`, which must be a decimal number from its first to its last character ("nan" and "inf"
// are numbers too; the exponent may be that of Fortran, 1.5D+00). Too small for a double: zero, as rounding has it.
// Nothing: not a number, or too large for a double.
std::optional<double> parse_number(std::string_view text);
// `text` as an integer of 64 bits; nothing: not an integer, or too large.
std::optional<std::int64_t> parse_integer(std::string_view text);

class TextReader final : public Source {
 public:
  TextReader(std::string_view bytes, std::string file, TextSyntax syntax);

  // Skips blanks, comments and ends of lines. Is there a token left?
  bool seek_token();
  // The next token of this line; nothing at the end of the line.
  std::optional<std::string_view> token();
  // Skips what is left of the line, which no backslash joins to the next: it may end a path of Windows.
  void skip_line();
  // Skips what is left of the line, which must be numbers; fails otherwise.
  void skip_numbers();
  // Fails if the line holds another token.
  void expect_line_end();

  // The next token of this line as a number or an integer; fails otherwise, having expected `what` for `subject`.
  double number(std::string_view what, std::string_view subject = {});
  std::int64_t integer(std::string_view what, std::string_view subject = {});
  // The next token of this line, or the failure that `what` was expected for `subject`.
  std::string_view expect_token(std::string_view what, std::string_view subject = {});
  // Fails with "expected <what> for <subject>, found <the token, or the end of the line or file>".
  [[noreturn]] void fail_expected(std::string_view what, std::optional<std::string_view> found,
                                  std::string_view subject = {}) const;
  std::int64_t place() const override { return line_; }
  // The byte after the last token.
  std::size_t offset() const { return offset_; }
  // Where the reader stands, and back to there.
  struct Mark {
    std::size_t offset;
    std::int64_t line;
  };
  Mark mark() const { return {offset_, line_}; }
  void go_back(const Mark& mark) {
    offset_ = mark.offset;
    line_ = mark.line;
  }

 private:
  std::string place_text(std::int64_t place) const override { return ":" + std::to_string(place); }
  std::size_t line_end_length(std::size_t at) const;  // 0: no line ends at `at`
  bool joins_lines(std::size_t at) const;             // is there a backslash at `at` that joins two lines?
  bool begins_comment(std::size_t at) const;
  void skip_blanks();

  TextSyntax syntax_;
  std::size_t offset_ = 0;
  std::int64_t line_ = 1;
};

}  // namespace tact::scenes

#include "scenes/files/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace tact::scenes {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

// from_chars knows no plus sign.
std::string_view without_plus(std::string_view text) {
  return text.starts_with('+') && !text.starts_with("+-") ? text.substr(1) : text;
}

// from_chars does not say on which side a number is out of range: the power of ten of the first digit does.
bool is_below_one(std::string_view number) {
  const std::size_t e = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, e);
  std::int64_t exponent = 0;
  if (e != std::string_view::npos) {
    const std::string_view text = without_plus(number.substr(e + 1));
    // Ten thousand trillion digits would be needed to make up for an exponent that is itself out of range.
    if (std::from_chars(text.data(), text.data() + text.size(), exponent).ec != std::errc())
      return text.starts_with('-');
  }
  const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
  const auto first = static_cast<std::int64_t>(digits.find_first_of("123456789"));
  return exponent < first - point;  // a sum with the exponent could overflow
}

// Fortran's exponent of a double: 1.5D+00. Nothing: the number has none.
std::optional<std::string> with_plain_exponent(std::string_view number) {
  constexpr std::size_t kLongest = 400;
  const std::size_t d = number.find_first_of("dD");
  if (d == std::string_view::npos || number.size() > kLongest) return std::nullopt;
  if (number.substr(0, d).find_first_not_of("+-.0123456789") != std::string_view::npos) return std::nullopt;
  std::string plain(number);
  plain[d] = 'e';
  return plain;
}

// What a token that is no number seems to be.
std::string_view seems_to_be(std::string_view token) {
  if (token.find("\xc2\xa0") != std::string_view::npos) return ", which holds a no-break space";
  const std::size_t comma = token.find(',');
  const bool decimal = comma != std::string_view::npos && comma > 0 && comma + 1 < token.size() &&
                       token.find_first_not_of("+-.,0123456789eE") == std::string_view::npos;
  return decimal ? ", with a comma where a number has a point" : "";
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  text = without_plus(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) {
    const auto plain = with_plain_exponent(text);
    return plain ? parse_number(*plain) : std::nullopt;
  }
  if (error == std::errc()) return value;
  if (error == std::errc::result_out_of_range && is_below_one(text)) return text.starts_with('-') ? -0.0 : 0.0;
  return std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  text = without_plus(text);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

TextReader::TextReader(std::string_view bytes, std::string file, TextSyntax syntax)
    : Source(bytes, std::move(file)), syntax_(syntax) {
  if (bytes_.starts_with("\xef\xbb\xbf")) offset_ = 3;
}

std::size_t TextReader::line_end_length(std::size_t at) const {
  if (at >= bytes_.size()) return 0;
  if (bytes_[at] == '\n') return 1;
  if (bytes_[at] != '\r') return 0;
  return at + 1 < bytes_.size() && bytes_[at + 1] == '\n' ? 2 : 1;
}

bool TextReader::joins_lines(std::size_t at) const {
  return syntax_.backslash_joins_lines && bytes_[at] == '\\' && line_end_length(at + 1) > 0;
}

// 1.#INF, as some programs write what is not finite, is one token.
bool TextReader::begins_comment(std::size_t at) const {
  return syntax_.comment != '\0' && bytes_[at] == syntax_.comment && (at == 0 || bytes_[at - 1] != '.');
}

void TextReader::skip_blanks() {
  while (offset_ < bytes_.size()) {
    if (is_blank(bytes_[offset_])) {
      ++offset_;
    } else if (joins_lines(offset_)) {
      offset_ += 1 + line_end_length(offset_ + 1);
      ++line_;
    } else if (begins_comment(offset_)) {
      return skip_line();
    } else {
      return;
    }
  }
}

bool TextReader::seek_token() {
  for (;;) {
    skip_blanks();
    if (offset_ >= bytes_.size()) return false;
    const std::size_t length = line_end_length(offset_);
    if (length == 0) return true;
    offset_ += length;
    ++line_;
  }
}

std::optional<std::string_view> TextReader::token() {
  skip_blanks();
  const std::size_t begin = offset_;
  while (offset_ < bytes_.size() && !is_blank(bytes_[offset_]) && line_end_length(offset_) == 0 &&
         !joins_lines(offset_) && !begins_comment(offset_)) {
    ++offset_;
  }
  if (offset_ == begin) return std::nullopt;
  return bytes_.substr(begin, offset_ - begin);
}

void TextReader::skip_line() { offset_ = std::min(bytes_.find_first_of("\r\n", offset_), bytes_.size()); }

void TextReader::skip_numbers() {
  while (const auto text = token()) {
    if (!parse_number(*text)) fail_expected("a number or the end of the line", text);
  }
}

void TextReader::expect_line_end() {
  if (const auto text = token()) fail_expected("the end of the line", text);
}

std::string_view TextReader::expect_token(std::string_view what, std::string_view subject) {
  const auto text = token();
  if (!text) fail_expected(what, text, subject);
  return *text;
}

double TextReader::number(std::string_view what, std::string_view subject) {
  const std::string_view text = expect_token(what, subject);
  const auto value = parse_number(text);
  if (!value) fail_expected(what, text, subject);
  return *value;
}

std::int64_t TextReader::integer(std::string_view what, std::string_view subject) {
  const std::string_view text = expect_token(what, subject);
  const auto value = parse_integer(text);
  if (!value) fail_expected(what, text, subject);
  return *value;
}

void TextReader::fail_expected(std::string_view what, std::optional<std::string_view> found,
                               std::string_view subject) const {
  const std::string purpose = subject.empty() ? std::string() : " for " + printable(subject);
  const std::string text = found                      ? in_quotes(*found).append(seems_to_be(*found))
                           : offset_ >= bytes_.size() ? "the end of the file"
                                                      : "the end of the line";
  fail(fmt::format("expected {}{}, found {}", what, purpose, text));
}

}  // namespace tact::scenes

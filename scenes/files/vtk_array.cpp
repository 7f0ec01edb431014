#include "scenes/files/vtk_array.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

#include "scenes/files/text_reader.h"

namespace tact::scenes {
namespace {

// Bytes from text in base64 or as they are. A size and what it counts may be two texts in base64, each with its end:
// every four letters are read by themselves.
class Bytes {
 public:
  Bytes(std::string_view text, bool base64, XmlReader& source) : text_(text), base64_(base64), source_(source) {}

  std::string take(std::uint64_t count) {
    if (count > room()) source_.fail("the array ends too early");
    while (decoded_.size() < count) decode();
    std::string taken = decoded_.substr(0, count);
    decoded_.erase(0, count);
    return taken;
  }
  // No more bytes than these can follow.
  std::uint64_t room() const { return decoded_.size() + text_.size(); }

 private:
  static int value_of(char c) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t at = kLetters.find(c);
    return at != std::string_view::npos ? static_cast<int>(at) : -1;
  }
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  // Some of the text, so that a large array is not moved for every number.
  void decode() {
    constexpr std::size_t kAtOnce = std::size_t{1} << 16;
    if (text_.empty()) source_.fail("the array ends too early");
    if (!base64_) {
      decoded_ += text_.substr(0, kAtOnce);
      return text_.remove_prefix(std::min(kAtOnce, text_.size()));
    }
    std::array<int, 4> letters{};
    for (std::size_t done = 0; done < kAtOnce; done += letters.size()) {
      int count = 0, padding = 0;
      for (; count < 4; ++count) {
        while (!text_.empty() && is_space(text_.front())) text_.remove_prefix(1);
        if (text_.empty()) break;
        const char c = text_.front();
        text_.remove_prefix(1);
        padding += c == '=';
        letters[static_cast<std::size_t>(count)] = c == '=' ? 0 : value_of(c);
        if (letters[static_cast<std::size_t>(count)] < 0) source_.fail(in_quotes({&c, 1}) + " is no letter of base64");
      }
      if (count == 0) return;
      if (count < 4 || padding > 2) source_.fail("base64 that ends within four letters");
      const int three = letters[0] << 18 | letters[1] << 12 | letters[2] << 6 | letters[3];
      for (int k = 0; k < 3 - padding; ++k) decoded_ += static_cast<char>(three >> (16 - 8 * k) & 255);
    }
  }

  std::string_view text_;
  bool base64_;
  XmlReader& source_;
  std::string decoded_;
};

template <class Number>
Number number_at(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> raw;
  std::copy_n(bytes, raw.size(), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

std::uint64_t size_from(Bytes& bytes, const VtkEncoding& encoding) {
  const std::string raw = bytes.take(encoding.header_bytes);
  return encoding.header_bytes == 8 ? number_at<std::uint64_t>(raw.data(), encoding.order)
                                    : number_at<std::uint32_t>(raw.data(), encoding.order);
}

std::string inflated(const std::string& packed, std::uint64_t size, XmlReader& source) {
  constexpr std::uint64_t kMostPerByte = 1032;  // what deflate can make of a byte: 258 bytes from 2 bits
  if (size > (packed.size() + 1) * kMostPerByte) source.fail("a block says that it is larger than it can be");
  std::string plain(size, '\0');
  uLongf got = size;
  const int result = uncompress(reinterpret_cast<Bytef*>(plain.data()), &got,
                                reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  if (result != Z_OK || got != size) source.fail("a block cannot be inflated");
  return plain;
}

std::string plain_bytes(Bytes& bytes, const VtkEncoding& encoding, XmlReader& source) {
  if (!encoding.deflated) return bytes.take(size_from(bytes, encoding));
  const std::uint64_t blocks = size_from(bytes, encoding);
  const std::uint64_t block_size = size_from(bytes, encoding), last_size = size_from(bytes, encoding);
  if (blocks > bytes.room() / encoding.header_bytes) source.fail("more blocks than the array has room for");
  std::vector<std::uint64_t> packed_sizes;
  for (std::uint64_t i = 0; i < blocks; ++i) packed_sizes.push_back(size_from(bytes, encoding));
  std::string plain;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const bool is_cut = i + 1 == blocks && last_size > 0;
    plain += inflated(bytes.take(packed_sizes[i]), is_cut ? last_size : block_size, source);
  }
  return plain;
}

template <class Number, class Wanted>
std::vector<Wanted> as_numbers(const std::string& plain, std::endian order, XmlReader& source) {
  if (std::is_floating_point_v<Number> && !std::is_floating_point_v<Wanted>) source.fail("its numbers are no integers");
  if (plain.size() % sizeof(Number) != 0) source.fail("it ends within a number");
  std::vector<Wanted> numbers(plain.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Number number = number_at<Number>(plain.data() + i * sizeof(Number), order);
    if constexpr (std::is_same_v<Number, std::uint64_t>) {
      if (number > std::numeric_limits<std::int64_t>::max()) source.fail("a number is larger than 2^63 - 1");
    }
    numbers[i] = static_cast<Wanted>(number);
  }
  return numbers;
}

template <class Wanted>
std::vector<Wanted> typed_numbers(const std::string& type, const std::string& plain, std::endian order,
                                  XmlReader& source) {
  if (type == "Float64") return as_numbers<double, Wanted>(plain, order, source);
  if (type == "Float32") return as_numbers<float, Wanted>(plain, order, source);
  if (type == "Int64") return as_numbers<std::int64_t, Wanted>(plain, order, source);
  if (type == "UInt64") return as_numbers<std::uint64_t, Wanted>(plain, order, source);
  if (type == "Int32") return as_numbers<std::int32_t, Wanted>(plain, order, source);
  if (type == "UInt32") return as_numbers<std::uint32_t, Wanted>(plain, order, source);
  if (type == "Int16") return as_numbers<std::int16_t, Wanted>(plain, order, source);
  if (type == "UInt16") return as_numbers<std::uint16_t, Wanted>(plain, order, source);
  if (type == "Int8") return as_numbers<std::int8_t, Wanted>(plain, order, source);
  if (type == "UInt8") return as_numbers<std::uint8_t, Wanted>(plain, order, source);
  source.fail(in_quotes(type) + " is no type of numbers");
}

template <class Wanted>
std::vector<Wanted> numbers_in_text(std::string_view text, XmlReader& source) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  std::vector<Wanted> numbers;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) return numbers;
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    if constexpr (std::is_floating_point_v<Wanted>) {
      if (const auto number = parse_number(word)) {
        numbers.push_back(*number);
        continue;
      }
    } else if (const auto number = parse_integer(word)) {
      numbers.push_back(*number);
      continue;
    }
    source.fail(fmt::format("number {}: expected {}, found {}", numbers.size(),
                            std::is_floating_point_v<Wanted> ? "a number" : "an integer", in_quotes(word)));
  }
}

template <class Wanted>
std::vector<Wanted> read_array(const VtkArray& array, const VtkEncoding& encoding, XmlReader& source) {
  source.set_place(array.line);
  if (array.format == "ascii") return numbers_in_text<Wanted>(array.text, source);
  const bool appended = array.format == "appended";
  if (!appended && array.format != "binary") source.fail(in_quotes(array.format) + " is no format of an array");
  if (appended && static_cast<std::uint64_t>(array.offset) > encoding.appended.size())
    source.fail(
        fmt::format("offset {} is behind the appended data, of {} bytes", array.offset, encoding.appended.size()));
  const std::string_view text =
      appended ? encoding.appended.substr(static_cast<std::size_t>(array.offset)) : array.text;
  Bytes bytes(text, !appended || encoding.appended_in_base64, source);
  return typed_numbers<Wanted>(array.type, plain_bytes(bytes, encoding, source), encoding.order, source);
}

}  // namespace

std::vector<double> numbers_of(const VtkArray& array, const VtkEncoding& encoding, XmlReader& source) {
  return read_array<double>(array, encoding, source);
}

std::vector<std::int64_t> integers_of(const VtkArray& array, const VtkEncoding& encoding, XmlReader& source) {
  return read_array<std::int64_t>(array, encoding, source);
}

}  // namespace tact::scenes

// Little-endian numbers out of bytes.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace tact::recording {

// The bytes end before what was to be read.
struct EndOfBytes {};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::size_t position() const { return position_; }
  void go_back_to(std::size_t position) { position_ = position; }
  std::size_t bytes_left() const { return bytes_.size() - position_; }
  // Where the number stands that was read last.
  std::size_t last() const { return last_; }

  // Each throws EndOfBytes and stays where it is if there are not so many.
  template <class Number>
  Number read() {
    Number value;
    require(sizeof value);
    std::memcpy(&value, bytes_.data() + position_, sizeof value);
    position_ += sizeof value;
    return value;
  }
  std::string_view read_bytes(std::size_t count) {
    require(count);
    const std::string_view read = bytes_.substr(position_, count);
    position_ += count;
    return read;
  }
  // Throws EndOfBytes unless `count` things of `size` bytes each are there.
  void require(std::uint64_t count, std::size_t size = 1) {
    if (count > bytes_left() / size) throw EndOfBytes{};
    last_ = position_;
  }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;
};

}  // namespace tact::recording

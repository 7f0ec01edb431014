// Numbers as the page reads them: little-endian, whole numbers in as few bytes as they need.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

namespace tact::scenes {

class ViewBytes {
 public:
  void add_byte(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  // Seven bits a byte, the lowest first; all but the last byte have the highest bit set.
  void add_count(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) add_byte(static_cast<std::uint8_t>(value | 0x80));
    add_byte(static_cast<std::uint8_t>(value));
  }
  // 0, -1, 1, -2, 2 ... as 0, 1, 2, 3, 4 ...
  void add_signed(std::int64_t value) {
    add_count(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
  }
  void add_double(double value) { add_raw(std::bit_cast<std::uint64_t>(value)); }
  void add_raw(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) add_byte(static_cast<std::uint8_t>(bits >> 8 * i));
  }
  void add_short(std::int16_t value) {
    add_byte(static_cast<std::uint8_t>(value));
    add_byte(static_cast<std::uint8_t>(value >> 8));
  }
  void add_float(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) add_byte(static_cast<std::uint8_t>(bits >> 8 * i));
  }

  // The other's length, and all of it.
  void add_part(const ViewBytes& part) {
    add_count(part.size());
    bytes_ += part.bytes_;
  }

  const std::string& bytes() const { return bytes_; }
  std::size_t size() const { return bytes_.size(); }
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

}  // namespace tact::scenes

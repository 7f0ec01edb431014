// A binary file as numbers of either byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "scenes/files/source.h"

namespace tact::scenes {

class BinaryReader final : public Source {
 public:
  // Begins at byte `offset`, which is not past the end.
  BinaryReader(std::string_view bytes, std::string file, std::size_t offset, std::endian order)
      : Source(bytes, std::move(file)), offset_(offset), last_(offset), order_(order) {}

  // The next number; fails if the file ends in it.
  template <class Number>
  Number read() {
    std::array<char, sizeof(Number)> raw;
    require(raw.size());
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset_), raw.size(), raw.begin());
    if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
    offset_ += raw.size();
    return std::bit_cast<Number>(raw);
  }
  // Skips `count` values of `size` bytes each; fails if there are fewer.
  void skip(std::uint64_t count, std::size_t size = 1) {
    require(count, size);
    offset_ += count * size;
  }
  std::size_t bytes_left() const { return bytes_.size() - offset_; }
  // The number that was read last is the one that a message is about.
  std::int64_t place() const override { return static_cast<std::int64_t>(last_); }

 private:
  std::string place_text(std::int64_t place) const override { return ": byte " + std::to_string(place); }
  void require(std::uint64_t count, std::size_t size = 1) {
    last_ = offset_;
    if (bytes_left() / size < count) fail("the file ends too early, after " + std::to_string(bytes_.size()) + " bytes");
  }

  std::size_t offset_;
  std::size_t last_;
  std::endian order_;
};

}  // namespace tact::scenes

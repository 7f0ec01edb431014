// Numbers as bytes between processes of one program, and back.
#pragma once

#include <tact/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace tact::mpi {

using Bytes = std::vector<std::byte>;

class ByteWriter {
 public:
  template <class... Numbers>
  void put(const Numbers&... numbers) {
    (put_one(numbers), ...);
  }
  template <class Number>
  void put_all(std::span<const Number> numbers) {
    put(std::uint64_t{numbers.size()});
    append(numbers.data(), numbers.size_bytes());
  }
  template <class Number>
  void put_all(const std::vector<Number>& numbers) {
    put_all(std::span(numbers));
  }
  Bytes& bytes() { return bytes_; }

 private:
  template <class Number>
  void put_one(const Number& number) {
    static_assert(std::is_arithmetic_v<Number> || std::is_enum_v<Number>);
    append(&number, sizeof number);
  }
  void append(const void* first, std::size_t size) {
    const auto* const bytes = static_cast<const std::byte*>(first);
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  }

  Bytes bytes_;
};

/// Errors: bad_state, if the bytes end early.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool at_end() const { return bytes_.empty(); }
  template <class Number>
  Number get() {
    static_assert(std::is_arithmetic_v<Number> || std::is_enum_v<Number>);
    if constexpr (std::is_same_v<Number, bool>) return get<std::uint8_t>() != 0;
    Number number;
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }
  std::span<const std::byte> rest() const { return bytes_; }
  std::span<const std::byte> get_bytes() { return take(get<std::uint64_t>()); }
  template <class Number>
  std::vector<Number> get_all() {
    const auto count = get<std::uint64_t>();
    check(count <= bytes_.size() / sizeof(Number));
    std::vector<Number> numbers(count);
    const std::span<const std::byte> from = take(numbers.size() * sizeof(Number));
    if (!numbers.empty()) std::memcpy(numbers.data(), from.data(), from.size());
    return numbers;
  }

 private:
  static void check(bool holds) {
    if (!holds) throw Error(ErrorCode::bad_state, "bytes of a rank end early");
  }
  std::span<const std::byte> take(std::uint64_t size) {
    check(size <= bytes_.size());
    const std::span<const std::byte> taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }

  std::span<const std::byte> bytes_;
};

}  // namespace tact::mpi

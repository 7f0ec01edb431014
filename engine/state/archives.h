// The two archives of fields.h: numbers become bytes, little-endian, without padding; and become numbers again. What is
// read is checked by its kind alone: whether it is there, flags, enumerations, that no number is NaN.
#pragma once

#include <tact/error.h>

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/state/fields.h"

namespace tact {

static_assert(std::endian::native == std::endian::little, "saved states are little-endian");

/// Integers, and nothing else: many of them are copied at once.
template <class T>
inline constexpr bool kIsPlain = std::integral<T> && !std::same_as<T, bool>;
template <class T, std::size_t kSize>
inline constexpr bool kIsPlain<std::array<T, kSize>> = kIsPlain<T>;
template <>
inline constexpr bool kIsPlain<FacetPair> = true;
template <>
inline constexpr bool kIsPlain<broadphase::IndexPair> = true;

class StateWriter {
 public:
  static constexpr bool kReads = false;

  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  void count(int value, std::size_t) { put(value); }
  template <class T, std::size_t kSize>
  void first(int count, const std::array<T, kSize>& values) {
    for (const T& value : std::span(values).first(static_cast<std::size_t>(count))) put(value);
  }
  template <class T>
  void pointee(const std::unique_ptr<T>& pointer) {
    put(*pointer);
  }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  void append(const void* first, std::size_t size);

  template <class T>
  void put(const T& value) {
    if constexpr (kIsPlain<T> || std::same_as<T, double> || std::is_enum_v<T> || std::same_as<T, bool>) {
      append(&value, sizeof value);
    } else {
      StateFields::visit(*this, value);
    }
  }
  void put(const std::string& text) { put_many(std::span(text)); }
  template <class T>
  void put(const std::vector<T>& values) {
    put_many(std::span(values));
  }
  template <class T, std::size_t kSize>
  requires(!kIsPlain<T>) void put(const std::array<T, kSize>& values) {
    for (const T& value : values) put(value);
  }

  template <class T>
  void put_many(std::span<const T> values) {
    put(std::uint64_t{values.size()});
    if constexpr (kIsPlain<T> || std::same_as<T, double>) {
      append(values.data(), values.size_bytes());
    } else {
      for (const T& value : values) put(value);
    }
  }

  std::vector<std::byte> bytes_;
};

/// Errors: bad_state.
class StateReader {
 public:
  static constexpr bool kReads = true;

  explicit StateReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  template <class T>
  T read() {
    T value;
    get(value);
    return value;
  }
  // A number of things, of which there is room for `most`.
  void count(int& value, std::size_t most) {
    get(value);
    check(value >= 0 && static_cast<std::size_t>(value) <= most, "a count is too large");
  }
  template <class T, std::size_t kSize>
  void first(int count, std::array<T, kSize>& values) {
    for (T& value : std::span(values).first(static_cast<std::size_t>(count))) get(value);
  }
  template <class T>
  void pointee(std::unique_ptr<T>& pointer) {
    pointer = std::make_unique<T>();
    get(*pointer);
  }

  std::size_t bytes_left() const { return bytes_.size() - position_; }
  std::span<const std::byte> rest() const { return bytes_.subspan(position_); }
  void check(bool holds, const char* otherwise) const {
    if (!holds) refuse(otherwise);
  }
  // A number of things of so many bytes each at least, which are still there.
  std::size_t read_size(std::size_t bytes_each) {
    const auto size = read<std::uint64_t>();
    check(size <= bytes_left() / bytes_each, "the state ends early");
    return static_cast<std::size_t>(size);
  }

 private:
  [[noreturn]] void refuse(const char* what) const;
  void take(void* to, std::size_t size);

  template <class T>
  void get(T& value) {
    if constexpr (kIsPlain<T>) {
      take(&value, sizeof value);
    } else if constexpr (std::same_as<T, bool>) {
      const auto flag = read<std::uint8_t>();
      check(flag <= 1, "a flag is neither 0 nor 1");
      value = flag == 1;
    } else if constexpr (std::is_enum_v<T>) {
      const auto number = read<std::underlying_type_t<T>>();
      check(static_cast<std::uint64_t>(number) <= static_cast<std::uint64_t>(kLastValue<T>), "a name has no meaning");
      value = static_cast<T>(number);
    } else if constexpr (std::same_as<T, double>) {
      take(&value, sizeof value);
      check(!std::isnan(value), "a number is NaN");
    } else {
      StateFields::visit(*this, value);
    }
  }
  void get(std::string& text) { get_many(text); }
  template <class T>
  void get(std::vector<T>& values) {
    get_many(values);
  }
  template <class T, std::size_t kSize>
  requires(!kIsPlain<T>) void get(std::array<T, kSize>& values) {
    for (T& value : values) get(value);
  }

  template <class Many>
  void get_many(Many& values) {
    using T = typename Many::value_type;
    constexpr bool kIsNumber = kIsPlain<T> || std::same_as<T, double>;
    const std::size_t size = read_size(kIsNumber ? sizeof(T) : 1);
    values.resize(size);
    if constexpr (kIsPlain<T>) {
      take(values.data(), size * sizeof(T));
    } else {
      for (T& value : values) get(value);
    }
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
};

}  // namespace tact

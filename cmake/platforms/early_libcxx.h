// What C++20 has and libc++ before version 15 has not: the algorithms over whole ranges that tact uses, the order of
// arrays, and before 14 std::bit_cast and numbers in messages. Compiled before every source where the standard library
// is such a one (TactTargets.cmake); nothing of it reaches a program that uses tact.
#pragma once

#include <version>
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <algorithm>
#include <array>
#include <charconv>
#include <compare>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <utility>

namespace std {

#if _LIBCPP_VERSION < 14000
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

// For messages: not always the shortest of all texts with the fewest digits that read back.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format, int digits) {
  const int written = snprintf(first, static_cast<size_t>(last - first), "%.*g", digits, value);
  return {first + min<ptrdiff_t>(written, last - first), errc()};
}
inline to_chars_result to_chars(char* first, char* last, double value) {
  for (int digits = 1;; ++digits) {
    const to_chars_result end = to_chars(first, last, value, chars_format::general, digits);
    if (digits == 17 || strtod(first, nullptr) == value) return end;
  }
}
#endif

template <class Value, size_t kCount>
constexpr auto operator<=>(const array<Value, kCount>& a, const array<Value, kCount>& b) {
  for (size_t i = 0; i < kCount; ++i) {
    if (const auto order = a[i] <=> b[i]; order != 0) return order;
  }
  return Value{} <=> Value{};
}

namespace ranges {

// Compares what is seen of two elements, or of an element and a value.
template <class Compare, class Seen>
constexpr auto tact_comparing(Compare& compare, Seen& seen) {
  return [&](const auto& a, const auto& b) -> bool {
    return std::invoke(compare, std::invoke(seen, a), std::invoke(seen, b));
  };
}

template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr auto sort(Range&& range, Compare compare = {}, Seen seen = {}) {
  std::sort(std::begin(range), std::end(range), tact_comparing(compare, seen));
  return std::end(range);
}
template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr auto stable_sort(Range&& range, Compare compare = {}, Seen seen = {}) {
  std::stable_sort(std::begin(range), std::end(range), tact_comparing(compare, seen));
  return std::end(range);
}
template <class Range, class Place, class Compare = std::less<>, class Seen = std::identity>
constexpr auto inplace_merge(Range&& range, Place middle, Compare compare = {}, Seen seen = {}) {
  std::inplace_merge(std::begin(range), middle, std::end(range), tact_comparing(compare, seen));
  return std::end(range);
}
template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr auto push_heap(Range&& range, Compare compare = {}, Seen seen = {}) {
  std::push_heap(std::begin(range), std::end(range), tact_comparing(compare, seen));
  return std::end(range);
}
template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr auto pop_heap(Range&& range, Compare compare = {}, Seen seen = {}) {
  std::pop_heap(std::begin(range), std::end(range), tact_comparing(compare, seen));
  return std::end(range);
}
template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr auto sort_heap(Range&& range, Compare compare = {}, Seen seen = {}) {
  std::sort_heap(std::begin(range), std::end(range), tact_comparing(compare, seen));
  return std::end(range);
}
template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr bool is_sorted(Range&& range, Compare compare = {}, Seen seen = {}) {
  return std::is_sorted(std::begin(range), std::end(range), tact_comparing(compare, seen));
}
template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr auto min_element(Range&& range, Compare compare = {}, Seen seen = {}) {
  return std::min_element(std::begin(range), std::end(range), tact_comparing(compare, seen));
}
template <class Range, class Compare = std::less<>, class Seen = std::identity>
constexpr auto max_element(Range&& range, Compare compare = {}, Seen seen = {}) {
  return std::max_element(std::begin(range), std::end(range), tact_comparing(compare, seen));
}
template <class Range>
constexpr auto min(Range&& range) {
  return *std::min_element(std::begin(range), std::end(range));
}
template <class Value>
struct tact_min_max {
  Value min, max;
};
template <class Range>
constexpr auto minmax(Range&& range) {
  const auto found = std::minmax_element(std::begin(range), std::end(range));
  return tact_min_max<std::decay_t<decltype(*std::begin(range))>>{*found.first, *found.second};
}

template <class Range, class Value, class Compare = std::less<>, class Seen = std::identity>
constexpr auto lower_bound(Range&& range, const Value& value, Compare compare = {}, Seen seen = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](const auto& one, const Value& given) -> bool {
    return std::invoke(compare, std::invoke(seen, one), given);
  });
}
template <class Range, class Value, class Compare = std::less<>, class Seen = std::identity>
constexpr auto upper_bound(Range&& range, const Value& value, Compare compare = {}, Seen seen = {}) {
  return std::upper_bound(std::begin(range), std::end(range), value, [&](const Value& given, const auto& one) -> bool {
    return std::invoke(compare, given, std::invoke(seen, one));
  });
}
template <class Range, class Value>
constexpr bool binary_search(Range&& range, const Value& value) {
  return std::binary_search(std::begin(range), std::end(range), value, std::less<>());
}

template <class Range, class Value, class Seen = std::identity>
constexpr auto find(Range&& range, const Value& value, Seen seen = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](const auto& one) -> bool { return std::invoke(seen, one) == value; });
}
template <class Range, class Test>
constexpr auto find_if(Range&& range, Test test) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](const auto& one) -> bool { return std::invoke(test, one); });
}
template <class Range, class Others>
constexpr auto find_first_of(Range&& range, Others&& others) {
  return std::find_first_of(std::begin(range), std::end(range), std::begin(others), std::end(others));
}
template <class Range, class Test = std::equal_to<>, class Seen = std::identity>
constexpr auto adjacent_find(Range&& range, Test test = {}, Seen seen = {}) {
  return std::adjacent_find(std::begin(range), std::end(range), tact_comparing(test, seen));
}
template <class Range, class Test>
constexpr bool any_of(Range&& range, Test test) {
  return std::any_of(std::begin(range), std::end(range),
                     [&](const auto& one) -> bool { return std::invoke(test, one); });
}
template <class Range, class Test>
constexpr bool all_of(Range&& range, Test test) {
  return std::all_of(std::begin(range), std::end(range),
                     [&](const auto& one) -> bool { return std::invoke(test, one); });
}
template <class Range, class Test>
constexpr bool none_of(Range&& range, Test test) {
  return !ranges::any_of(range, test);
}
template <class Range, class Value>
constexpr auto count(Range&& range, const Value& value) {
  return std::count(std::begin(range), std::end(range), value);
}
template <class Range, class Test>
constexpr auto count_if(Range&& range, Test test) {
  return std::count_if(std::begin(range), std::end(range),
                       [&](const auto& one) -> bool { return std::invoke(test, one); });
}
template <class Range, class Others, class Test = std::equal_to<>>
constexpr bool equal(Range&& range, Others&& others, Test test = {}) {
  return std::equal(std::begin(range), std::end(range), std::begin(others), std::end(others), test);
}

template <class Range, class Value>
constexpr auto fill(Range&& range, const Value& value) {
  std::fill(std::begin(range), std::end(range), value);
  return std::end(range);
}
template <class Range>
constexpr auto reverse(Range&& range) {
  std::reverse(std::begin(range), std::end(range));
  return std::end(range);
}
template <class From, class To>
struct tact_in_out {
  From in;
  To out;
};
template <class Range, class To>
constexpr auto copy(Range&& range, To to) {
  const auto out = std::copy(std::begin(range), std::end(range), to);
  return tact_in_out<decltype(std::end(range)), To>{std::end(range), out};
}
template <class Range, class To, class Test>
constexpr auto copy_if(Range&& range, To to, Test test) {
  return std::copy_if(std::begin(range), std::end(range), to,
                      [&](const auto& one) -> bool { return std::invoke(test, one); });
}
template <class Range, class To, class Function>
constexpr auto transform(Range&& range, To to, Function function) {
  return std::transform(std::begin(range), std::end(range), to, function);
}
template <class Range, class Others, class To>
constexpr auto merge(Range&& range, Others&& others, To to) {
  return std::merge(std::begin(range), std::end(range), std::begin(others), std::end(others), to);
}

}  // namespace ranges
}  // namespace std

#endif

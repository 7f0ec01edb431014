// Quotients and roots of integers, rounded once: numbers that are equal stay equal, others keep their order.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/double_parts.h"
#include "narrowphase/numeric/wide_integer.h"

namespace tact::narrowphase {

// Whether a number that is off from `value` by less than `error` certainly rounds to its head.
inline bool rounds_to_head(DoubleDouble value, double error) {
  return value.head + (value.tail + error) == value.head && value.head + (value.tail - error) == value.head;
}

// The double nearest to a positive number, of two equally near ones the even one. `near` is a double some roundings
// from it; beyond(sum) is the sign of twice the number minus the sum of two doubles.
template <class Beyond>
double rounded(double near, const Beyond& beyond) {
  const auto is_odd = [](double x) { return (std::bit_cast<std::uint64_t>(x) & 1) != 0; };
  const auto is_passed = [&](double next, int sign) {
    const int side = sign * beyond(near, next);
    return side > 0 || (side == 0 && is_odd(near));
  };
  for (double next; is_passed(next = std::nextafter(near, std::numeric_limits<double>::infinity()), 1);) near = next;
  for (double next; near > 0.0 && is_passed(next = std::nextafter(near, 0.0), -1);) near = next;
  return near;
}

// The sum of two neighbouring doubles in units of 2^(unit - 1075), where `unit` is at least 1.
struct SumOfNeighbors {
  SumOfNeighbors(double x, double y) : unit(std::min(lowest_bit(x), lowest_bit(y))) {
    in_units_of_it = in_units<1>(x, unit) + in_units<1>(y, unit);
  }
  int unit;
  WideInteger<2> in_units_of_it;
};

template <int kCapacity>
WideInteger<kCapacity> power_of_two(int exponent) {
  return {false, 1, exponent};
}

// a / b for 0 <= a <= b, b > 0.
template <int A, int B>
double rounded_quotient(const WideInteger<A>& a, const WideInteger<B>& b) {
  if (a.sign() == 0) return 0.0;
  const int bits_a = a.bit_count(), bits_b = b.bit_count();
  const double near = std::ldexp(a.times_power(bits_a) / b.times_power(bits_b), bits_a - bits_b);
  return rounded(near, [&](double x, double y) {  // these are below 2: their unit is below 2^0
    const SumOfNeighbors sum(x, y);
    return (power_of_two<18>(1076 - sum.unit) * a - sum.in_units_of_it * b).sign();
  });
}

// The root of a / b, a >= 0, b > 0, times 2^(unit - 1075).
template <int A, int B>
double rounded_root(const WideInteger<A>& a, const WideInteger<B>& b, int unit) {
  if (a.sign() == 0) return 0.0;
  const int bits_a = a.bit_count(), bits_b = b.bit_count(), odd = (bits_a - bits_b) & 1;
  const double square = a.times_power(bits_a - odd) / b.times_power(bits_b);
  const double near = std::ldexp(std::sqrt(square), (bits_a - bits_b - odd) / 2 + unit - 1075);
  return rounded(near, [&](double x, double y) {
    const SumOfNeighbors sum(x, y);
    const auto of_a = power_of_two<66>(2 * std::max(unit - sum.unit, 0) + 2) * a;
    const auto of_b =
        power_of_two<66>(2 * std::max(sum.unit - unit, 0)) * (sum.in_units_of_it * sum.in_units_of_it * b);
    return (of_a - of_b).sign();
  });
}

}  // namespace tact::narrowphase

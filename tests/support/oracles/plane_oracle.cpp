#include "tests/support/oracles/plane_oracle.h"

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tact::tests {

namespace {

using Rational = boost::multiprecision::cpp_rational;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Rational height(const ExactPlane& plane, Vec3 p) {
  return Rational(plane.normal.x) * Rational(p.x) + Rational(plane.normal.y) * Rational(p.y) +
         Rational(plane.normal.z) * Rational(p.z) - Rational(plane.offset);
}

// The largest double that is not above a number.
double rounded_down(const Rational& number) {
  auto near = number.convert_to<double>();
  while (Rational(near) > number) near = std::nextafter(near, -kInfinity);
  while (Rational(std::nextafter(near, kInfinity)) <= number) near = std::nextafter(near, kInfinity);
  return near;
}

double nearest(const Rational& number) {
  const double below = rounded_down(number), above = std::nextafter(below, kInfinity);
  const Rational to_below = number - Rational(below), to_above = Rational(above) - number;
  if (to_below != to_above) return to_below < to_above ? below : above;
  return (std::bit_cast<std::uint64_t>(below) & 1) == 0 ? below : above;
}

std::optional<Rational> time_of(const ExactPlane& plane, Vec3 from, Vec3 to, double reach) {
  const Rational begin = height(plane, from), end = height(plane, to), near(reach);
  if (abs(begin) <= near) return Rational(0);
  const Rational level = begin > 0 ? near : Rational(-near);
  if (begin > 0 ? end > level : end < level) return {};
  return Rational((begin - level) / (begin - end));
}

}  // namespace

double exact_height(const ExactPlane& plane, Vec3 p) { return nearest(height(plane, p)); }

std::optional<double> exact_time(const ExactPlane& plane, Vec3 from, Vec3 to, double reach) {
  const auto time = time_of(plane, from, to, reach);
  return time ? std::optional(rounded_down(*time)) : std::nullopt;
}

std::optional<double> exact_fraction(const ExactPlane& plane, Vec3 from, Vec3 to) {
  const auto time = time_of(plane, from, to, 0.0);
  return time ? std::optional(nearest(*time)) : std::nullopt;
}

}  // namespace tact::tests

#include "narrowphase/motion/turning_way.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace tact::narrowphase {

namespace {

// What each term of Taylor's series is of the one before, but for the square: 1 / (n (n + 1)), of the sine from n = 2
// on, of the cosine from n = 1 on.
constexpr std::array<double, 8> terms_from(int first) {
  std::array<double, 8> terms{};
  for (int i = 0; i < 8; ++i) terms[static_cast<std::size_t>(i)] = 1.0 / ((first + 2 * i) * (first + 2 * i + 1));
  return terms;
}
constexpr std::array<double, 8> kOfSine = terms_from(2), kOfCosine = terms_from(1);

}  // namespace

// Quarter turns are taken off in three parts (Cody and Waite, "Software Manual for the Elementary Functions", 1980):
// the first two have 33 bits each, so that their products with up to 2^10 quarters are exact. What is left is at most
// pi/4, where the next term of either series is below 2^-60.
SineCosine sine_cosine(double angle) {
  if (angle == 0.0) return {};
  constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34, kThird = 0x1.3198a2e037073p-69;
  const double quarters = std::floor(angle * (2.0 * std::numbers::inv_pi) + 0.5);
  const double rest = ((angle - quarters * kFirst) - quarters * kSecond) - quarters * kThird;
  const double square = rest * rest;
  double sine = 1.0, cosine = 1.0;
  for (std::size_t i = kOfSine.size(); i-- > 0;) {
    sine = 1.0 - kOfSine[i] * square * sine;
    cosine = 1.0 - kOfCosine[i] * square * cosine;
  }
  sine *= rest;
  switch (static_cast<int>(quarters) & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
  }
}

double time_of_fall(double gap, double speed, double acceleration) {
  if (!(gap > 0.0)) return 0.0;
  const double root = std::sqrt(speed * speed + 2.0 * acceleration * gap);
  // As a quotient of what does not cancel.
  if (speed > 0.0) return 2.0 * gap / (speed + root);
  return acceleration > 0.0 ? (root - speed) / acceleration : std::numeric_limits<double>::infinity();
}

}  // namespace tact::narrowphase

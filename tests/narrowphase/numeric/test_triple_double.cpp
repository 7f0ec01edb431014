#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "narrowphase/numeric/double_parts.h"
#include "narrowphase/numeric/triple_double.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

// In units of 2^-1000.
WideInteger<20> exact(double x) { return in_units<20>(x, 75); }
auto exact(const TripleDouble& x) { return exact(x.head) + exact(x.middle) + exact(x.tail); }

TripleDouble any(Random& random) {
  TripleDouble x(random.uniform(-1.0, 1.0));
  x = x + random.uniform(-0x1p-54, 0x1p-54);
  x = x + random.uniform(-0x1p-108, 0x1p-108);
  return random.chance(0.3) ? x * TripleDouble(0x1p-60) : x;
}

// Of the exact results at most a part of 2^150 is lost.
TEST(TripleDouble, HasTheDigitsThatItPromises) {
  const WideInteger<16> one(false, 1, 1000);  // in the unit
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const TripleDouble a = any(random), b = any(random);
    const auto of_a = exact(a), of_b = exact(b);
    EXPECT_LE((exact(a + b) - (of_a + of_b)).bit_count(), std::max(of_a.bit_count(), of_b.bit_count()) - 150) << i;
    const auto product = of_a * of_b;
    EXPECT_LE((exact(a * b) * one - product).bit_count(), product.bit_count() - 150) << i;
    const auto wide_a = of_a * one;
    EXPECT_LE((exact(a / b) * of_b - wide_a).bit_count(), wide_a.bit_count() - 149) << i;
  }
}

// Heads and middles that cancel leave the tails.
TEST(TripleDouble, KnowsTheSignOfWhatCancels) {
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const TripleDouble a = any(random);
    const double least = std::ldexp(random.uniform(0.5, 1.0), -random.below(140)) * a.head;
    if (least == 0.0) continue;
    const TripleDouble difference = (a + least) - a;
    EXPECT_EQ(std::signbit(difference.head), std::signbit(least)) << i;
    EXPECT_NEAR(difference.head / least, 1.0, 1e-2) << i;
    EXPECT_TRUE(a < a + std::abs(least)) << i;
    EXPECT_EQ((a - a).head, 0.0) << i;
  }
}

}  // namespace
}  // namespace tact::narrowphase

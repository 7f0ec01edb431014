// Double-doubles with a bound, against integers of any size.
#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/numeric/bounded_number.h"
#include "narrowphase/numeric/double_parts.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

constexpr int kUnit = 1075;  // the exponent of 1: see double_parts.h

BoundedNumber bounded(double x) { return BoundedNumber(DoubleDouble{x, 0.0}); }

// Products of three numbers of 50 bits have 150, of which a double-double keeps 106.
TEST(BoundedNumber, SignIsRightOrUnclear) {
  tests::Random random(7);
  int clear = 0, unclear = 0, zero = 0;
  for (int round = 0; round < 20000; ++round) {
    double x[6];
    for (int i = 0; i < 3; ++i) {
      x[i] = std::floor(random.uniform(-0x1p50, 0x1p50));
      x[i + 3] = x[i];
    }
    // Nearly equal products, by 2^-50 to 2^-150 of themselves, or equal ones of other order.
    if (random.chance(0.8)) x[3 + random.below(3)] += random.below(3) - 1;
    if (random.chance(0.3)) std::swap(x[3], x[5]);
    const auto product = [](const auto& a, const auto& b, const auto& c) { return a * b * c; };
    const auto exact = [](double v) { return in_units<2>(v, kUnit); };
    const int truth =
        (product(exact(x[0]), exact(x[1]), exact(x[2])) - product(exact(x[3]), exact(x[4]), exact(x[5]))).sign();
    BoundedNumber::unclear() = false;
    const int sign =
        (product(bounded(x[0]), bounded(x[1]), bounded(x[2])) - product(bounded(x[3]), bounded(x[4]), bounded(x[5])))
            .sign();
    (BoundedNumber::unclear() ? unclear : clear) += 1;
    zero += truth == 0 ? 1 : 0;
    if (!BoundedNumber::unclear()) {
      ASSERT_EQ(sign, truth) << "round " << round;
    }
  }
  EXPECT_GT(clear, 5000);
  EXPECT_GT(unclear, 1000);
  EXPECT_GT(zero, 1000);
}

TEST(BoundedNumber, EqualNumbersAndZerosAreCertain) {
  BoundedNumber::unclear() = false;
  EXPECT_EQ((bounded(0.1) - bounded(0.1)).sign(), 0);
  EXPECT_EQ((bounded(0.0) * bounded(0.3)).sign(), 0);
  EXPECT_FALSE(BoundedNumber::unclear());
  // What has been rounded is never certain to be equal.
  EXPECT_EQ((bounded(0.1) * bounded(0.3) - bounded(0.3) * bounded(0.1)).sign(), 0);
  EXPECT_TRUE(BoundedNumber::unclear());
}

TEST(BoundedNumber, OneThatIsCertainIsEnough) {
  const BoundedNumber product = bounded(0.1) * bounded(0.3), nothing = product - product;
  BoundedNumber::unclear() = false;
  EXPECT_FALSE(all_zero(nothing, nothing, bounded(1e-30)));
  EXPECT_FALSE(BoundedNumber::unclear());
  EXPECT_TRUE(all_zero(nothing, nothing, bounded(0.0)));
  EXPECT_TRUE(BoundedNumber::unclear());
}

}  // namespace
}  // namespace tact::narrowphase

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "narrowphase/numeric/wide_integer.h"

namespace tact::narrowphase {
namespace {

using Integer = WideInteger<33>;

TEST(WideInteger, SmallValuesAreThoseOfTheMachine) {
  for (std::int64_t a = -20; a <= 20; ++a) {
    for (std::int64_t b = -20; b <= 20; ++b) {
      const auto wide = [](std::int64_t x) { return Integer(x < 0, static_cast<std::uint64_t>(x < 0 ? -x : x), 0); };
      EXPECT_EQ((wide(a) + wide(b) - wide(a + b)).sign(), 0) << a << ' ' << b;
      EXPECT_EQ((wide(a) * wide(b) - wide(a * b)).sign(), 0) << a << ' ' << b;
      EXPECT_EQ((wide(a) - wide(b)).sign(), (a > b) - (a < b)) << a << ' ' << b;
    }
  }
}

TEST(WideInteger, CarriesAndBorrowsRunThroughAllLimbs) {
  const Integer one(false, 1, 0);
  const Integer top(false, 1, 64 * 33 - 1);
  const auto below = top - one;  // every bit below the top is set
  EXPECT_EQ((top - below).sign(), 1);
  EXPECT_EQ((top - below - one).sign(), 0);
  EXPECT_EQ((below + one - top).sign(), 0);
  EXPECT_EQ((top + top - top - top).sign(), 0);
  EXPECT_EQ((below * below - (top * top - top - top + one)).sign(), 0);
}

TEST(WideInteger, RandomValuesObeyTheLawsOfArithmetic) {
  std::mt19937_64 random(7);
  const auto any = [&] {
    const int shift = static_cast<int>(random() % 2000);
    return Integer(random() % 2 == 0, random() >> (random() % 64), shift) +
           Integer(random() % 2 == 0, random(), shift / 2);
  };
  for (int i = 0; i < 5000; ++i) {
    const auto a = any(), b = any(), c = any();
    ASSERT_EQ((a + b - a - b).sign(), 0) << i;
    ASSERT_EQ((a - b).sign(), -(b - a).sign()) << i;
    ASSERT_EQ((a * (b + c) - (a * b + a * c)).sign(), 0) << i;
    ASSERT_EQ(((a + b) * (a - b) - (a * a - b * b)).sign(), 0) << i;
    ASSERT_EQ((a * b).sign(), a.sign() * b.sign()) << i;
  }
}

}  // namespace
}  // namespace tact::narrowphase

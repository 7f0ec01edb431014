#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include "engine/base/floating_point_mode.h"
#include "tests/support/environment/floating_point_state.h"

namespace {

using tact::base::FloatingPointMode;

// Reads from memory each time, so that the compiler cannot compute the sum itself.
double sum_of(const volatile double& a, const volatile double& b) { return a + b; }
double half_of(const volatile double& a) { return a * 0.5; }

const volatile double kOne = 1.0;
const volatile double kTiny = std::numeric_limits<double>::min() / 4;
const volatile double kSmallestNormal = std::numeric_limits<double>::min();

TEST(FloatingPointMode, RoundsToNearestAndGivesTheCallersModeBack) {
  for (const int callers : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(callers), 0);
    double inside = 0.0;
    {
      const FloatingPointMode mode;
      inside = sum_of(kOne, kTiny);
    }
    const double outside = sum_of(kOne, kTiny);
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(inside, 1.0);
    EXPECT_EQ(outside > 1.0, callers == FE_UPWARD);
    EXPECT_EQ(after, callers);
  }
}

TEST(FloatingPointMode, GivesTheModeBackWhenAnExceptionPasses) {
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  try {
    const FloatingPointMode mode;
    throw 1;
  } catch (int) {
  }
  const double after = sum_of(kOne, kTiny);
  std::fesetround(FE_TONEAREST);
  EXPECT_GT(after, 1.0);
}

TEST(FloatingPointMode, KeepsSubnormalNumbersWhereTheCallerFlushesThem) {
  if (!tact::tests::kCanFlushSubnormals) GTEST_SKIP() << "this processor cannot flush them";
  double result = 0.0, operand = 0.0, flushed_result = 0.0, flushed_operand = 0.0;
  bool still_flushes = false;
  {
    const tact::tests::SavedFloatingPointState saved;
    tact::tests::flush_subnormals();
    {
      const FloatingPointMode mode;
      result = half_of(kSmallestNormal);
      operand = sum_of(kTiny, kTiny);
    }
    flushed_result = half_of(kSmallestNormal);
    flushed_operand = sum_of(kTiny, kTiny);
    still_flushes = tact::tests::flushes_subnormals();
  }
  EXPECT_EQ(result, std::numeric_limits<double>::min() / 2);
  EXPECT_EQ(operand, std::numeric_limits<double>::min() / 2);
  EXPECT_EQ(flushed_result, 0.0);
  EXPECT_EQ(flushed_operand, 0.0);
  EXPECT_TRUE(still_flushes) << "the caller's mode was not given back";
}

}  // namespace

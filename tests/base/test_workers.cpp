#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/workers.h"

namespace {

using tact::base::Workers;

TEST(Workers, AreAsManyAsWantedWhileNothingIsLost) {
  Workers workers;
  for (int k = 0; k < 100; ++k) workers.note(8, 8, 5.0, 0.1);   // a thread that was asleep
  for (int k = 0; k < 100; ++k) workers.note(8, 8, 50.0, 5.0);  // a little of a long loop
  EXPECT_EQ(workers.allowed(8), 8);
  EXPECT_FALSE(workers.limited());
}

TEST(Workers, AreHalfAsManyUntilEightTimesTheLossIsWorked) {
  Workers workers;
  workers.note(8, 8, 6.0, 5.0);
  EXPECT_EQ(workers.allowed(8), 4);
  EXPECT_EQ(workers.allowed(2), 2);
  workers.note(4, 8, 39.0, 0.0);
  EXPECT_EQ(workers.allowed(8), 4);
  workers.note(4, 8, 2.0, 0.0);
  EXPECT_EQ(workers.allowed(8), 8);
}

TEST(Workers, GoDownToOneAndReturnStepByStep) {
  Workers workers;
  workers.note(8, 8, 6.0, 5.0);
  workers.note(4, 8, 6.0, 5.0);
  workers.note(2, 8, 6.0, 5.0);
  EXPECT_EQ(workers.allowed(8), 1);
  for (const int expected : {2, 4, 8}) {
    workers.note(1, 8, 5000.0, 0.0);
    EXPECT_EQ(workers.allowed(8), expected);
  }
}

// The pauses grow from 40 ms to 5 s.
TEST(Workers, TryTwiceAsLateEachTimeItFailsAgain) {
  Workers workers;
  double pause_ms = 40.0;
  for (int k = 0; k < 12; ++k) {
    workers.note(2, 2, 6.0, 5.0);
    workers.note(1, 2, pause_ms - 0.5, 0.0);
    ASSERT_EQ(workers.allowed(2), 1) << "try " << k;
    workers.note(1, 2, 1.0, 0.0);
    ASSERT_EQ(workers.allowed(2), 2) << "try " << k;
    pause_ms = std::min(2.0 * pause_ms, 5000.0);
  }
  workers.note(2, 2, pause_ms + 1.0, 0.0);  // as long without a loss: the past is forgotten
  workers.note(2, 2, 6.0, 5.0);
  workers.note(1, 2, 40.5, 0.0);
  EXPECT_EQ(workers.allowed(2), 2);
}

TEST(Workers, OfAScopeEndWithIt) {
  Workers outer, inner;
  EXPECT_EQ(Workers::current(), nullptr);
  {
    const Workers::Scope scope(outer);
    {
      const Workers::Scope nested(inner);
      EXPECT_EQ(Workers::current(), &inner);
    }
    EXPECT_EQ(Workers::current(), &outer);
  }
  EXPECT_EQ(Workers::current(), nullptr);
}

}  // namespace

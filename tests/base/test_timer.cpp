#include <gtest/gtest.h>

#include "engine/base/timer.h"

namespace tact::base {
namespace {

void wait(double ms) {
  for (Timer part; ms > 0.0;) ms -= part.lap();
}

TEST(Timer, TicksAgreeWithTheClock) {
  if (!TickCounter::exists()) GTEST_SKIP() << "this processor has no counter of constant rate";
  TickCounter::tick_ms();
  wait(2.0);
  const double tick_ms = TickCounter::tick_ms();
  ASSERT_GT(tick_ms, 0.0);
  Timer outer;
  Timer ticks(tick_ms);
  Timer inner;
  wait(5.0);
  const double least = inner.lap(), counted = ticks.lap(), most = outer.lap();
  EXPECT_GT(counted, 0.98 * least);
  EXPECT_LT(counted, 1.02 * most);
}

TEST(Timer, WithoutTicksAsksTheClock) {
  Timer timer(0.0);
  const auto begin = timer.start();
  wait(0.5);
  const double ms = timer.lap();
  EXPECT_EQ(ms, (std::chrono::duration<double, std::milli>(timer.start() - begin).count()));
  EXPECT_GE(ms, 0.5);
}

}  // namespace
}  // namespace tact::base

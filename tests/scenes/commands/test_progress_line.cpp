#include <gtest/gtest.h>

#include "scenes/commands/progress_line.h"

namespace tact::scenes {
namespace {

TEST(ProgressText, TellsShareTimeLeftAndNote) {
  EXPECT_EQ(progress_text("step", 120, 300, 8.0, "38 contacts"), "step 120 of 300, 40 %, 12 s left, 38 contacts");
  EXPECT_EQ(progress_text("frame", 1, 3, 0.1, ""), "frame 1 of 3, 33 %, 1 s left");
  EXPECT_EQ(progress_text("step", 1, 1000, 1.0, ""), "step 1 of 1000, 0 %, 17 min left");
}

TEST(ProgressText, NothingDoneAndAllDone) {
  EXPECT_EQ(progress_text("step", 0, 300, 0.0, ""), "step 0 of 300, 0 %");
  EXPECT_EQ(progress_text("step", 300, 300, 3.0, ""), "step 300 of 300, 100 %, 0 s left");
}

// The tests' standard error is no terminal, or they run in less than the second for which the line is silent.
TEST(ProgressLine, IsQuietForShortWork) {
  ::testing::internal::CaptureStderr();
  ProgressLine line("step", 2, ProgressLine::Beside::nothing);
  line.show(1);
  line.show(2);
  line.clear();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace tact::scenes

#include "scenes/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace tact::scenes {

ProgressLine::ProgressLine(int frames)
    : frames_(frames),
      wanted_(isatty(STDERR_FILENO) != 0 && isatty(STDOUT_FILENO) == 0),
      next_(Clock::now() + std::chrono::seconds(1)) {}

void ProgressLine::show(int done) {
  if (!wanted_ || Clock::now() < next_) return;
  next_ = Clock::now() + std::chrono::milliseconds(100);
  fmt::print(stderr, "\rframe {} of {}", done, frames_);
  shown_ = true;
}

void ProgressLine::clear() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
  shown_ = false;
}

}  // namespace tact::scenes

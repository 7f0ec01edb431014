// A line on standard error that tells how far a long run is, for people only.
#pragma once

#include <chrono>

namespace tact::scenes {

// Silent unless standard error is a terminal and standard output is not, and in the first second.
class ProgressLine {
 public:
  explicit ProgressLine(int frames);
  // Frame number `done` of the frames is done.
  void show(int done);
  // Takes the line away.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  int frames_;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace tact::scenes

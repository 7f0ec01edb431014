// A line on standard error that tells how far a long run is, for people only.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace tact::scenes {

// "step 120 of 300, 40 %, 12 s left, 38 contacts": `unit` is what is counted, the seconds left follow from those that
// the steps so far took, `note` may be empty.
std::string progress_text(std::string_view unit, int done, int all, double seconds, std::string_view note);

// Silent unless standard error is a terminal, and in the first second.
class ProgressLine {
 public:
  enum class Beside {
    nothing,  // nothing else is written meanwhile
    output,   // standard output is: silent as well if that is a terminal
  };

  ProgressLine(std::string unit, int all, Beside beside);
  // Takes the line away, so that a message about what ended the work does not stand in it.
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  // Number `done` of all is done.
  void show(int done, std::string_view note = {});
  // Takes the line away.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string unit_;
  int all_;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace tact::scenes

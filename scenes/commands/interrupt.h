// Ctrl-C as a flag, so that a long run can end with what was done so far.
#pragma once

#include <csignal>

namespace tact::scenes {

// How a long run ended.
enum class Ending { complete, interrupted };

// While one lives, the first SIGINT is only remembered; a second one ends the program as usual. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  // Has SIGINT come since construction?
  bool requested() const;

 private:
  struct sigaction before_ {};
};

}  // namespace tact::scenes

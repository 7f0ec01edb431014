// What is thrown for a command line that asks for what cannot be.
#pragma once

#include <stdexcept>

namespace tact::scenes {

// `what()` is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tact::scenes

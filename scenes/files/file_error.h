// What is thrown for a file that cannot be read or written.
#pragma once

#include <stdexcept>

namespace tact::scenes {

// `what()` is one line: the file, the line or byte, the vertex or facet if there is one, what was expected and what was
// found.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tact::scenes

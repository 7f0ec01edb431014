// Several things of which each is tried, whatever became of those before it.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "scenes/files/file_error.h"

namespace tact::scenes {

class Failures {
 public:
  // Calls action() and keeps the message of what it throws.
  template <class Action>
  void attempt(const Action& action) {
    try {
      action();
    } catch (const std::bad_alloc&) {
      add("out of memory");
    } catch (const std::exception& error) {
      add(error.what());
    }
  }

  // Throws FileError with all messages in their order, in one line, if there are any.
  void report() const {
    if (!messages_.empty()) throw FileError(messages_);
  }

 private:
  void add(std::string_view message) {
    if (!messages_.empty()) messages_ += "; ";
    messages_ += message;
  }

  std::string messages_;
};

}  // namespace tact::scenes

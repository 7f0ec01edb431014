// Memory that runs out becomes the error that the interface names.
#pragma once

#include <tact/error.h>

#include <new>

namespace tact {

// There may be no memory for the message either.
[[noreturn]] inline void refuse_memory(const char* what) {
  try {
    throw Error(ErrorCode::out_of_memory, what);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, {});
  }
}

// Returns work(); a failed allocation in it, that of another error's message say, becomes Error out_of_memory.
template <class Work>
decltype(auto) with_memory(const char* what, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    refuse_memory(what);
  }
}
template <class Work>
decltype(auto) with_memory(const Work& work) {
  return with_memory("the call ran out of memory", work);
}

}  // namespace tact

// The one place with OpenMP in it. An item writes only to a slot of its own, so nothing depends on the number of
// threads; an exception is caught in its item and the one of the lowest index is thrown again after the loop.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <type_traits>

#include "engine/base/floating_point_mode.h"

namespace tact::base {

// The number of threads that `threads = 0` stands for.
inline int default_threads() { return omp_get_max_threads(); }

// How many neighbouring items to give out at a time: few enough that threads end together, and up to `most` of them,
// so that what an item asks memory for is wanted by the same thread.
inline std::size_t grain_of(std::size_t count, int threads, std::size_t least, std::size_t most) {
  constexpr std::size_t kBlocksPerThread = 32;
  return std::clamp(count / (kBlocksPerThread * static_cast<std::size_t>(threads)), least, most);
}

template <class Work>
void call_work(const Work& work, std::size_t item, int thread) {
  if constexpr (std::is_invocable_v<const Work&, std::size_t, int>) {
    work(item, thread);
  } else {
    work(item);
  }
}

// Calls work(i), or work(i, thread) with 0 <= thread < threads, for every 0 <= i < count, `grain` neighbouring items at
// a time, on up to `threads` threads. With one thread, or no more than `grain` items, it runs in the calling thread.
template <class Work>
void parallel_for(std::size_t count, std::size_t grain, int threads, const Work& work) {
  if (threads <= 1 || count <= grain) {
    const FloatingPointMode mode;
    for (std::size_t i = 0; i < count; ++i) call_work(work, i, 0);
    return;
  }
  std::exception_ptr first;
  std::size_t first_index = count;
  const auto blocks = static_cast<std::ptrdiff_t>((count + grain - 1) / grain);
#pragma omp parallel num_threads(threads)
  {
    const FloatingPointMode mode;
    const int thread = omp_get_thread_num();
#pragma omp for schedule(dynamic, 1)
    for (std::ptrdiff_t block = 0; block < blocks; ++block) {
      const std::size_t begin = static_cast<std::size_t>(block) * grain;
      const std::size_t end = begin + grain < count ? begin + grain : count;
      for (std::size_t i = begin; i < end; ++i) {
        try {
          call_work(work, i, thread);
        } catch (...) {
#pragma omp critical(tact_parallel_for_exception)
          if (i < first_index) {
            first_index = i;
            first = std::current_exception();
          }
          break;
        }
      }
    }
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace tact::base

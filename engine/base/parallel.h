// The one place with OpenMP in it. An item writes only to a slot of its own, so nothing depends on the number of
// threads; an exception is caught in its item and the one of the lowest index is thrown again after the loop.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
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

// The blocks that one thread begins with, and takes one by one; the others help when they are done with theirs.
struct alignas(64) BlockShare {
  std::atomic<std::size_t> next;
  std::size_t end;
};

// Calls work(i), or work(i, thread) with 0 <= thread < threads, for every 0 <= i < count, `grain` neighbouring items at
// a time, on up to `threads` threads. With one thread, or no more than `grain` items, it runs in the calling thread. Of
// loops over the same items a thread takes the same part, as far as it can, and finds them in its cache.
template <class Work>
void parallel_for(std::size_t count, std::size_t grain, int threads, const Work& work) {
  if (threads <= 1 || count <= grain) {
    const FloatingPointMode mode;
    for (std::size_t i = 0; i < count; ++i) call_work(work, i, 0);
    return;
  }
  std::exception_ptr first;
  std::size_t first_index = count;
  const std::size_t blocks = (count + grain - 1) / grain;
  constexpr std::size_t kMostShares = 16;
  BlockShare shares[kMostShares];
  const std::size_t share_count = std::min({static_cast<std::size_t>(threads), blocks, kMostShares});
  for (std::size_t k = 0; k < share_count; ++k) {
    shares[k].next.store(blocks * k / share_count, std::memory_order_relaxed);
    shares[k].end = blocks * (k + 1) / share_count;
  }
  const auto run_block = [&](std::size_t block, int thread) {
    for (std::size_t i = block * grain, end = std::min(i + grain, count); i < end; ++i) {
      try {
        call_work(work, i, thread);
      } catch (...) {
#pragma omp critical(tact_parallel_for_exception)
        if (i < first_index) {
          first_index = i;
          first = std::current_exception();
        }
        return;
      }
    }
  };
#pragma omp parallel num_threads(threads)
  {
    const FloatingPointMode mode;
    const int thread = omp_get_thread_num();
    for (std::size_t k = 0; k < share_count; ++k) {
      BlockShare& share = shares[(static_cast<std::size_t>(thread) + k) % share_count];
      const auto take = [&] { return share.next.fetch_add(1, std::memory_order_relaxed); };
      for (std::size_t block = take(); block < share.end; block = take()) run_block(block, thread);
    }
    // By this, as at the end of a work-sharing loop, the thread sanitizer sees that nothing here is read any more.
#pragma omp barrier
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace tact::base

// The trees that many rays read: one of each mesh for all threads, or one for each thread. It is slow to read what
// another thread has written, and to write what another has read. So where rays are many for the trees, each thread
// makes its own. Answers do not depend on it.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/bodies/bodies.h"
#include "narrowphase/queries/segment_batch.h"

namespace tact {

class RayTrees {
 public:
  /// Prepares for so many rays that so many threads ask of the bodies as they are now.
  void begin(const Bodies& bodies, std::size_t rays, int threads);
  /// Those that a thread reads. Different threads may ask at once.
  const narrowphase::SegmentBatch& of_thread(const Bodies& bodies, int thread);

 private:
  // Rays of a thread for a node of its own. A node takes as long as eight rays, and as long as to read it from another
  // thread's cache. 10,000 rays to 100 k facets on two threads took 0.6 of the time, 600 rays to 10 k facets half.
  static constexpr std::size_t kRaysOfOwnNode = 2;
  // 12 kB each. More are in no cache of another thread either: one tree of 1 M facets is as fast.
  static constexpr std::size_t kMostOwnNodes = 1024;

  struct Trees {
    narrowphase::SegmentBatch batch;
    bool made = false;
  };
  static void make(const Bodies& bodies, int threads, Trees& trees);

  std::vector<Trees> trees_;  // those of the threads, as far as each has its own, else those of all in front
  bool own_ = false;
};

}  // namespace tact

// Memory of pairs that are looked at soon: prefetched some pairs ahead, as records and small bodies are scattered.
#pragma once

#include <span>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"

namespace tact {

class PairPrefetch {
 public:
  /// `grain` pairs are given to a thread at a time.
  PairPrefetch(const Bodies& bodies, std::span<const MovedPair> moved, std::size_t grain, int threads);

  /// Prefetches what pairs after the i-th need; a thread calls it before it looks at the i-th.
  void prefetch_after(std::size_t i) const;
  /// Whether it pays: not where all bodies are likely in the cache.
  bool pays() const { return pays_; }

 private:
  const Bodies& bodies_;
  std::span<const MovedPair> moved_;
  std::size_t grain_;
  bool one_thread_;
  bool pays_;
};

}  // namespace tact

// Memory of pairs that are looked at soon: asked for some pairs ahead, as records and small bodies are scattered.
#pragma once

#include <span>

#include "engine/bodies.h"
#include "engine/pair/pair_table.h"

namespace tact {

class PairPrefetch {
 public:
  /// `grain` pairs are given to a thread at a time.
  PairPrefetch(const Bodies& bodies, std::span<const MovedPair> moved, std::size_t grain, int threads);

  /// Asks for what the pairs after the i-th need; a thread calls it before it looks at the i-th.
  void ask_ahead_of(std::size_t i) const;
  /// Does it pay? Not where all bodies are likely in the cache.
  bool pays() const { return pays_; }

 private:
  void ask_for_first_bodies(std::size_t i, std::size_t own_end) const;
  void ask_for_pairs(std::size_t i, std::size_t own_end) const;

  const Bodies& bodies_;
  std::span<const MovedPair> moved_;
  std::size_t grain_;
  bool one_thread_;
  bool pays_;
  bool few_pairs_;  // than bodies: the first body of a pair is seldom that of the last
};

}  // namespace tact

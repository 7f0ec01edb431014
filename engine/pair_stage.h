// Stages 3 to 6 over all pairs that a step looks at: each pair through separate_by_kdop, test_hulls, find_direction,
// cull and confirm, into its own record.
#pragma once

#include <tact/settings.h>

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "engine/base/timer.h"
#include "engine/bodies/bodies.h"
#include "engine/pair/confirm.h"
#include "engine/pair/pair_table.h"
#include "engine/pair/pair_work.h"

namespace tact {

class PairStage {
 public:
  /// Looks at table.moved(), in parallel; after it these are the pairs that no axis of a k-DOP separates. Clocks are of
  /// the kind of `timer`.
  void run(PairTable& table, Bodies& bodies, const Settings& settings, narrowphase::EmbreeDevice& device,
           const base::Timer& timer);

  /// What all pairs of the last run() cost, and the milliseconds of separate_by_kdop().
  PairCounts counts() const;
  double kdop_ms() const { return kdop_ms_; }
  /// The pairs that were shared out among threads.
  std::span<const std::unique_ptr<LargePair>> large() const { return std::span(large_).first(large_count_); }
  void forget_large() { large_count_ = 0; }
  /// From then on no thread had other pairs; some ranges may have been searched before.
  TraceEvent::Time large_begin() const { return large_begin_; }
  /// Gives back its memory.
  void forget();

 private:
  /// The clock of a thread: runs from pair to pair, once the first has begun.
  struct alignas(64) ThreadClock {
    base::Timer timer;
    bool begun = false;
  };
  struct LeftRange {
    LargePair* pair;
    std::size_t range;
  };
  void look_at(const PairInput& pair, PairRecord& record, PairTable& table, narrowphase::EmbreeDevice& device,
               int thread);
  void put_aside(CulledPair& culled, int threads, const base::Tuning& tuning);
  bool confirm_next_range(const base::Tuning& tuning, int thread);
  void confirm_large_pairs(int threads, const base::Tuning& tuning);

  std::vector<PairWork> work_;                     // a thread each
  std::vector<ThreadClock> clocks_;                // a thread each
  std::vector<std::unique_ptr<LargePair>> large_;  // large_count_ of them are in use
  std::size_t large_count_ = 0;
  std::mutex large_mutex_;
  std::vector<LeftRange> left_ranges_;  // scratch
  TraceEvent::Time large_begin_;
  double kdop_ms_ = 0.0;
};

}  // namespace tact

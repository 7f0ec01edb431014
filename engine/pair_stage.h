// Stages 3 to 6 over all pairs that a step looks at: each pair through separate_by_kdop, test_hulls, find_direction,
// cull and confirm, into its own record.
#pragma once

#include <tact/settings.h>

#include <vector>

#include "engine/base/timer.h"
#include "engine/bodies/bodies.h"
#include "engine/pair/confirm.h"
#include "engine/pair/pair_table.h"
#include "engine/pair/pair_work.h"
#include "engine/pair/plane_pair.h"

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
  /// The pairs that were shared out among threads, and from when on no thread had other pairs; some ranges may have
  /// been searched before.
  const LargePairs& large() const { return large_; }
  TraceEvent::Time large_begin() const { return large_begin_; }
  void forget_large() { large_.begin(); }

 private:
  /// The clock of a thread: runs from pair to pair, once the first has begun.
  struct alignas(64) ThreadClock {
    base::Timer timer;
    bool begun = false;
  };
  void begin(PairRecord& record, int thread);
  double note(PairRecord& record, float PairTimes::*of_pair, double PairCounts::*sum, int thread);
  void look_at(const PairTask& pair, PairTable& table, narrowphase::EmbreeDevice& device, int thread);
  void look_at(const BodyAndPlane& pair, double reach, const Settings& settings, PairRecord& record, int thread);

  std::vector<PairWork> work_;       // a thread each
  std::vector<ThreadClock> clocks_;  // a thread each
  LargePairs large_;
  TraceEvent::Time large_begin_;
  double kdop_ms_ = 0.0;
};

}  // namespace tact

// The events of a step, made from times that the step and its pairs note anyway.
#pragma once

#include <tact/statistics.h>
#include <tact/trace.h>

#include <span>
#include <vector>

#include "engine/pair/pair_table.h"
#include "engine/pair_stage.h"

namespace tact {

class StepTrace {
 public:
  using Time = TraceEvent::Time;

  // Notes stage 1, which comes before the step. Call make_room() before, so that this cannot fail.
  void make_room() {
    if (refreshes_.size() == refreshes_.capacity()) refreshes_.reserve(2 * refreshes_.size() + 1);
  }
  void add_refresh(Time begin, Time end) { refreshes_.push_back({TraceEvent::Kind::refresh, 0, begin, end}); }
  void forget_refreshes() { refreshes_.clear(); }

  // What make() takes of memory: after this it cannot fail.
  void make_room_for(std::span<const MovedPair> pairs, const PairStage& narrow_phase, std::vector<TraceEvent>& events);
  // Replaces `events` by those of a step from `begin` to `end`, with the refreshes before it, sorted by thread and
  // time; an event stands before those within it. `pairs` are those that the step looked at and no k-DOP separates.
  void make(Time begin, Time end, const StepStats& stats, std::span<const MovedPair> pairs,
            const PairStage& narrow_phase, std::vector<TraceEvent>& events);

 private:
  void add_pairs(std::span<const MovedPair> pairs, std::vector<TraceEvent>& events);
  void add_separated(Time begin, const StepStats& stats, std::vector<TraceEvent>& events);

  std::vector<TraceEvent> refreshes_;
  std::vector<const PairRecord*> by_thread_;  // scratch
};

}  // namespace tact

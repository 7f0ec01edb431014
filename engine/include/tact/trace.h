// What each thread did, and when.
#pragma once

#include <tact/body.h>

#include <chrono>
#include <cstdint>

namespace tact {

/// A part of one thread's work. Those of a thread are nested or apart.
struct TraceEvent {
  enum class Kind {
    refresh,       ///< stage 1: a call of World::set_positions since the last step, or grouping facets anew
    detect,        ///< World::detect() but for that: all that follows
    sweep,         ///< stage 2
    narrow_phase,  ///< stages 3 to 6 of all pairs, on the thread that called; `pair` and `small_pairs` are of each
                   ///< thread
    pair,          ///< one pair that took 20 microseconds or more: the stages that follow
    hulls,         ///< stage 3 of it
    direction,     ///< stage 4 of it
    cull,          ///< stage 5 of it
    confirm,       ///< stage 6 of it; of all large pairs what is left of it when there are no other pairs, in one event
                   ///< on the thread that called, which names the pair if it is the only one
    range,         ///< one thread's part in stage 6 of a large pair, in `confirm` or before it
    small_pairs,   ///< pairs that took less, one after the other
    /// pairs that an axis of the 18-DOPs separates: all are asked at once, on all threads, shown on the one that called
    kdop_separated_pairs,
    containment,  ///< bodies that are wholly inside others; this and those that follow on the thread that called
    points,       ///< contact points of pairs of bodies
    self_facets,  ///< facet pairs of bodies with themselves
    self_points,  ///< contact points of bodies with themselves
    patches,      ///< patches
    report,  ///< stage 7
  };
  /// When: on the system's steady clock.
  using Time = std::chrono::steady_clock::time_point;

  Kind kind = Kind::detect;   ///< what was done
  int thread = 0;             ///< from 0, the one that called
  Time begin = {}, end = {};  ///< of the stretch
  BodyId a = {}, b = {};      ///< the pair that `pair`, its stages and its ranges tell of
  std::int64_t count = 0;     ///< pair, confirm, range: facet pairs that meet; small_pairs, kdop_separated_pairs: pairs
};

}  // namespace tact

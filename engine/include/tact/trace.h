// What each thread did, and when.
#pragma once

#include <tact/body.h>

#include <chrono>
#include <cstdint>

namespace tact {

/// A part of one thread's work. Those of a thread are nested or apart.
struct TraceEvent {
  /// The work of an event.
  enum class Kind {
    refresh,               ///< stage 1: a call of World::set_positions(), or grouping facets again
    detect,                ///< World::detect() without stage 1
    sweep,                 ///< stage 2
    narrow_phase,          ///< stages 3 to 6 of all pairs, on the thread that called
    pair,                  ///< a pair that took 20 microseconds or more, with the four stages that follow
    hulls,                 ///< stage 3 of a pair
    direction,             ///< stage 4 of a pair
    cull,                  ///< stage 5 of a pair
    confirm,               ///< stage 6 of a pair, or what was left of it for all large pairs
    range,                 ///< the part of a thread in stage 6 of a large pair
    small_pairs,           ///< pairs that took less, one after the other
    kdop_separated_pairs,  ///< pairs that an axis of the 18-DOPs separates, on all threads
    containment,           ///< bodies that are wholly inside others
    curves,                ///< intersection curves
    points,                ///< contact points of pairs of bodies
    self_facets,           ///< facet pairs of bodies with themselves
    self_points,           ///< contact points of bodies with themselves
    patches,               ///< patches
    report,                ///< stage 7
    within_reach,          ///< pairs of features within reach
  };
  using Time = std::chrono::steady_clock::time_point;

  Kind kind = Kind::detect;   ///< the work
  int thread = 0;             ///< counted from 0, the thread that called
  Time begin = {}, end = {};  ///< on the system's steady clock
  BodyId a = {}, b = {};      ///< the bodies of a pair, its stages and its ranges
  std::int64_t count = 0;     ///< facet pairs that meet; pairs of small_pairs and kdop_separated_pairs
};

}  // namespace tact

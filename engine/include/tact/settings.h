// What a world promises and how much of the machine it uses.
#pragma once

#include <tact/executor.h>
#include <tact/message.h>

#include <memory>

namespace tact {

/// What a report promises of its pairs.
enum class Accuracy {
  /// do the convex hulls overlap, in which direction, how deep; no facets, so no zones nor patches, and what touched
  /// has ended
  hulls,
  paper,  ///< the paper's three criteria, then confirmation; may miss facet pairs on folds, spikes and clamped bodies
  exact,  ///< every facet pair that meets and no other
};

/// Where the contact direction of a pair comes from.
enum class DirectionPolicy {
  carried,   ///< from the pair's direction of the last step, so that a body is pushed back the way it came in
  smallest,  ///< the direction of the smallest separation of the hulls, anew in every step
};

/// Outputs beyond direction, depth and facet pairs. What is not asked for is not computed, but zones at
/// Accuracy::paper, which needs them. Where zones are known they drop facets, so fewer are kept.
struct Outputs {
  bool zones = false;    ///< Contact::zone_a, zone_b: the smallest disks around the impact zones
  bool patches = false;  ///< Contact::patches(): connected sets of facet pairs and points, with names that last
  bool points =
      false;           ///< Contact::points(): where surfaces come nearer than the sum of their margins, or have crossed
  bool trace = false;  ///< Report::trace(): which thread did what, and when
};

/// How a world works. World::set_settings() checks it (bad_settings).
struct Settings {
  /// 0 to 1024; 0: as many as OpenMP would use, of which World::settings() then tells the number. They are OpenMP's,
  /// unless there is an executor. While other programs keep the processor busy, fewer are used: a world notices what it
  /// loses by waiting for threads that do not run. What holds for OpenMP holds here: GCC's ends the program if a thread
  /// cannot be started, and a child of fork() can use one thread only.
  int threads = 0;
  Accuracy accuracy = Accuracy::exact;                   ///< what is promised of facet pairs
  DirectionPolicy direction = DirectionPolicy::carried;  ///< where contact directions come from
  /// Relative gap at which GJK stops, 1e-15 to 0.1. A larger one saves some support queries of new contacts; directions
  /// end on a face of the Minkowski difference all the same.
  double gjk_tolerance = 1e-12;
  int iteration_limit = 100;  ///< shifted calls of GJK a pair and step, at least 1
  Outputs outputs = {};       ///< what is wanted beyond direction, depth and facet pairs
  /// Threads of the program's own that do the work, `threads` tasks at a time; null: OpenMP's. The answers are the
  /// same. Held by the world; called only within its functions.
  std::shared_ptr<Executor> executor = {};
  /// Is told of each limit that a step reached; the report has the same as flags and counts. Null: nobody.
  MessageFunction on_message = {};
};

}  // namespace tact

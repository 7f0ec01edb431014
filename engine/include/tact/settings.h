// What a world promises and how much of the machine it uses.
#pragma once

#include <tact/executor.h>
#include <tact/message.h>

#include <memory>

namespace tact {

/// What a report promises of its pairs.
enum class Accuracy {
  hulls,  ///< overlap, direction and depth of the convex hulls; neither zones nor facet pairs
  paper,  ///< the paper's three criteria, then confirmation; may miss facet pairs
  exact,  ///< every facet pair that meets and no other
};

/// Where the contact direction of a pair comes from.
enum class DirectionPolicy {
  carried,   ///< the direction of the last step, so that a body leaves the way it came in
  smallest,  ///< the smallest separation of the hulls, from scratch in every step
};

/// Outputs beyond direction, depth and facet pairs. Only what is requested is computed; Accuracy::paper always computes
/// zones. Where zones are known they drop facets, so fewer are kept.
struct Outputs {
  bool zones = false;    ///< Contact::zone_a and zone_b
  bool patches = false;  ///< Contact::patches() and Report::patch_events()
  bool points = false;   ///< Contact::points()
  bool curves = false;   ///< Contact::curves()
  bool trace = false;    ///< Report::trace()
  /// Contact::within_reach()
  bool within_reach = false;
};

/// How a world works. World::set_settings() checks it.
struct Settings {
  /// The number of threads, 0 to 1024. 0 uses as many as the machine offers; World::settings() returns the number.
  /// While other programs keep the processor busy, fewer are used.
  int threads = 0;
  Accuracy accuracy = Accuracy::exact;                   ///< what is promised of facet pairs
  DirectionPolicy direction = DirectionPolicy::carried;  ///< where contact directions come from
  /// The relative gap at which GJK stops, 1e-15 to 0.1. A larger one saves support queries of new contacts.
  double gjk_tolerance = 1e-12;
  int iteration_limit = 100;  ///< shifted calls of GJK a pair and step, at least 1
  Outputs outputs = {};       ///< what is computed beyond direction, depth and facet pairs
  /// Runs the work on threads of the program, `threads` tasks at a time. Null uses OpenMP's threads.
  std::shared_ptr<Executor> executor = {};
  /// Called for each limit that a step reached, and for each body that was added as closed and is not. The report has
  /// limits as flags and counts. May be null.
  MessageFunction on_message = {};
};

}  // namespace tact

// Impacts between two steps, while every vertex moves straight.
#pragma once

#include <tact/body.h>
#include <tact/error.h>
#include <tact/feature_pair.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace tact {

/// Which impacts World::detect_motion() finds.
enum class Impacts {
  all,            ///< every pair of features that meets
  first_of_pair,  ///< the earliest of each pair of bodies; faster
  first,          ///< the earliest of all; the fastest
};

/// What World::detect_motion() looks for.
struct MotionOptions {
  Impacts wanted = Impacts::all;  ///< which impacts
  /// How near features come to meet, metres, zero or more; by default the sum of their rest offsets.
  std::optional<double> distance = {};
  bool bounds = false;  ///< whether to find how far each vertex may go; requires Impacts::all
};

/// A vertex and a facet, or two edges, that meet between the last step and now. With rest offsets they meet where they
/// come as near as the sum of these; the manual draws the rule for features that begin nearer.
struct Impact {
  BodyId a;                                      ///< its key is below that of b; equal to b for a body with itself
  BodyId b;                                      ///< the second body
  FeaturePair kind = FeaturePair::vertex_facet;  ///< which features meet
  /// The part of the way, 0 to 1, at which they first meet; never later than the true time.
  double time = 0.0;
  std::array<int, 3> a_vertices{-1, -1, -1};  ///< vertices of the feature of a; -1 fills up
  std::array<int, 3> b_vertices{-1, -1, -1};  ///< vertices of the feature of b; -1 fills up
  /// False if they touch and part, or slide along each other: the surfaces around them do not cross there.
  bool stops = true;
};

/// Two bodies, or one with itself, with at least one impact.
struct ImpactPair {
  BodyId a;                         ///< its key is not above that of b
  BodyId b;                         ///< the second body
  double first_time = 0.0;          ///< the earliest time of the impacts that stop; infinity if none does
  std::span<const Impact> impacts;  ///< sorted by time; valid as long as the report
};

/// Counts and times, milliseconds, of World::detect_motion().
struct MotionStats {
  std::int64_t moved_bodies = 0;   ///< bodies with other positions than in the last step
  std::int64_t body_pairs = 0;     ///< pairs of bodies whose boxes come near on their way, and bodies with themselves
  std::int64_t cluster_pairs = 0;  ///< pairs of clusters whose boxes come near on their way
  std::int64_t candidates = 0;     ///< pairs of features whose boxes come near on their way
  std::int64_t searched = 0;       ///< candidates that the filter left undecided
  std::int64_t spans = 0;          ///< parts of the way that the search looked at
  std::int64_t impacts = 0;        ///< impacts that are reported
  double sweep_ms = 0.0;           ///< the search for bodies that pass each other
  double search_ms = 0.0;          ///< all other work
};

/// What World::detect_motion() found. It is valid until the next call, World::restore(), or the end of the
/// world.
class TACT_API MotionReport {
 public:
  MotionReport() = default;
  MotionReport(const MotionReport&) = delete;  // views the world's data
  MotionReport& operator=(const MotionReport&) = delete;

  /// Returns the earliest time of an impact that stops, 0 to 1; infinity if none does.
  double first_time() const { return first_time_; }
  /// Returns the impacts, sorted by (a, b), time and features.
  std::span<const Impact> impacts() const { return impacts_; }
  /// Returns the pairs of bodies that meet, sorted by (a, b).
  std::span<const ImpactPair> pairs() const { return pairs_; }
  /// Returns for each vertex of a body how far along its way it may go, 0 to 1, if bounds were requested. All may go so
  /// far at once, and come through nothing. It is empty for a body that did not move.
  std::span<const double> bounds(BodyId body) const;
  /// Returns counts and times.
  const MotionStats& stats() const { return stats_; }

 private:
  friend class MotionStage;
  struct BodyBounds {
    BodyId body;
    std::vector<double> of_vertices;
  };
  std::vector<Impact> impacts_;
  std::vector<ImpactPair> pairs_;
  double first_time_ = std::numeric_limits<double>::infinity();
  MotionStats stats_;
  std::vector<BodyBounds> bounds_;
};

}  // namespace tact

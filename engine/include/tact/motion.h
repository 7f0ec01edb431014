// What meets between two steps, while every vertex moves straight.
#pragma once

#include <tact/body.h>
#include <tact/error.h>
#include <tact/feature_pair.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tact {

/// What World::detect_motion() looks for. Less is faster.
enum class Impacts {
  all,            ///< every pair of features that meets
  first_of_pair,  ///< of each pair of bodies the earliest; of equal ones, the least by features
  first,          ///< the earliest of all
};

/// A vertex and a facet, or two edges, that share a point at some time between the last step and now. Where bodies have
/// margins: that come as near as the sum of these; or, where they begin nearer, or by less than a thousandth above it,
/// that come to a tenth of the distance with which they begin. So a solver that stops before each impact still gets on:
/// what it has stopped at the sum of the margins goes below it next, where detect() reports a contact.
struct Impact {
  BodyId a;  ///< a.index <= b.index; of a body with itself a == b, and the vertex, or the lesser edge, is that of a
  BodyId b;
  FeaturePair kind = FeaturePair::vertex_facet;
  /// When first, as a part of the way from 0 to 1. It is never later than the true time, and earlier by less than 1e-6,
  /// unless the two come within 1e-11 of their size and way before they meet. Features that share a point at the
  /// beginning have 0.
  double time = 0.0;
  /// The vertices of either feature; -1 fills up. Those of an edge ascend, those of a facet stand in its own order.
  std::array<int, 3> a_vertices{-1, -1, -1};
  std::array<int, 3> b_vertices{-1, -1, -1};
};

/// Two bodies, or one twice, with at least one impact.
struct ImpactPair {
  BodyId a;
  BodyId b;
  double first_time = 0.0;
  std::span<const Impact> impacts;  ///< sorted by time; valid as long as the report
};

/// What detect_motion() did and how long it took.
struct MotionStats {
  std::int64_t moved_bodies = 0;   ///< bodies with other positions than in the last step
  std::int64_t body_pairs = 0;     ///< pairs of bodies, one moved, whose boxes on the way overlap; and single bodies
  std::int64_t cluster_pairs = 0;  ///< pairs of clusters whose boxes on the way overlap
  std::int64_t candidates = 0;     ///< pairs of features whose boxes on the way overlap
  std::int64_t searched = 0;       ///< of them, those that the filter did not settle
  std::int64_t spans = 0;          ///< parts of the way that were looked at for these
  std::int64_t impacts = 0;        ///< that are reported
  double sweep_ms = 0.0;           ///< which bodies pass each other
  double search_ms = 0.0;          ///< all else
};

/// Valid until the world's next detect_motion(), or its destruction.
class TACT_API MotionReport {
 public:
  MotionReport() = default;
  MotionReport(const MotionReport&) = delete;  // what it shows is the world's: take a reference
  MotionReport& operator=(const MotionReport&) = delete;

  /// The earliest time of all, 0 to 1; infinity if nothing meets.
  double first_time() const { return first_time_; }
  /// Sorted by (a, b), then by time, then by features.
  std::span<const Impact> impacts() const { return impacts_; }
  /// Sorted by (a, b).
  std::span<const ImpactPair> pairs() const { return pairs_; }
  const MotionStats& stats() const { return stats_; }

 private:
  friend class MotionStage;
  std::vector<Impact> impacts_;
  std::vector<ImpactPair> pairs_;
  double first_time_ = std::numeric_limits<double>::infinity();
  MotionStats stats_;
};

}  // namespace tact

// A segment, ready for many queries: which boxes it enters and when, which facets it meets and where.
#pragma once

#include <cstdint>
#include <optional>

#include "narrowphase/distance/segment_facet.h"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/box_arrays.h"

namespace tact::narrowphase {

class PreparedSegment {
 public:
  explicit PreparedSegment(const Segment& segment);

  /// As the kernels take it.
  const SegmentSlabs& slabs() const { return slabs_; }
  /// When it enters a box, as rank_by_entry() has it: not later than any place in the box where it meets a triangle.
  /// Infinite if it misses the box. That of a box around another one is not later.
  double entry(const Box& box) const;
  /// A bit for each facet of a cluster that it may meet.
  std::uint64_t facets_seen(const ClusteredMesh& mesh, int cluster) const;

  /// The first place where it meets a triangle, if it does: decided exactly. The time is the exact one, rounded once,
  /// and so not before entry() into any box around the triangle. There is the place of the triangle, to 1e-12 of the
  /// size of both.
  std::optional<CommonPlace> meet(const Triangle& triangle, PredicateCounts& counts) const;

 private:
  std::optional<CommonPlace> meet_exactly(const Triangle& triangle, PredicateCounts& counts) const;

  Segment segment_;
  SegmentSlabs slabs_{};
  LineOfSight line_{};
  double way_ = 0.0;  // along the last axis of line_
  bool is_point_ = false;
};

}  // namespace tact::narrowphase

// The first facets of many segments, a few segments at a time: each step is done for all of them
// before the next, so that the processor need not wait for, nor guess, what one of them turns out to be.
//
// What a segment may meet is found in floats, from the tree that SegmentBatch has; what it meets is decided as for one
// segment alone, so the answers are the same.
#pragma once

#include <optional>
#include <span>

#include "narrowphase/queries/mesh_queries.h"
#include "narrowphase/queries/segment_batch.h"

namespace tact::narrowphase {

/// A segment on its way through meshes, and the first hit of one of them that is not later than `latest`.
struct FirstHitQuery {
  Segment segment;
  double latest = 1.0;
  std::optional<FacetHit> hit = {};

  void take(const FacetHit& other) {
    if (other.time > latest || (hit && !(other < *hit))) return;
    hit = other;
    latest = other.time;
  }
};

inline constexpr std::size_t kLinesAtATime = LineBlock::kLines;

/// Asks a mesh up to kLinesAtATime queries; each hit is that of first_hit(). The tree is the mesh's or null.
void ask_first_hits(const ClusteredMesh& mesh, const LineTree* tree, std::span<FirstHitQuery* const> queries);

}  // namespace tact::narrowphase

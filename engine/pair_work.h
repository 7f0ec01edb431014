// Stages 3 to 6 for one pair of bodies. Reads the two bodies, writes the pair's record and nothing else.
#pragma once

#include <memory>
#include <vector>

#include "engine/bodies.h"
#include "engine/pair_record.h"
#include "narrowphase/confirm.h"
#include "narrowphase/minkowski_difference.h"
#include "narrowphase/minkowski_face.h"
#include "narrowphase/smallest_separation.h"

namespace tact {

// A part of stage 6 of a large pair, as a trace tells it.
struct ConfirmedRange {
  int thread = 0;
  TraceEvent::Time begin, end;
  std::int64_t facet_pairs = 0;
};

// A pair between the criteria and the confirmation, and the memory for both; reused from pair to pair.
struct PairWork {
  PairRecord* record = nullptr;
  narrowphase::ConfirmInput input;
  narrowphase::KeptClusters kept_a, kept_b;
  std::vector<narrowphase::ClusterPair> cluster_pairs;
  std::vector<narrowphase::Point2> zone_points;
  std::vector<std::int32_t> boxes_found;
  narrowphase::FaceFinder faces;
  narrowphase::SmallestMemory smallest;
  bool surface_is_placed = false;  // smallest.surface is the record's, where the bodies are now
  narrowphase::CullCounts cull_a, cull_b;
  narrowphase::FacetPairSearch search;
  std::vector<ConfirmedRange> ranges;  // of a large pair, from `ranges_begin` on
  TraceEvent::Time ranges_begin;
};

// Stages 3 to 5: do the hulls overlap, in which direction and how deep, which clusters are left, and which pairs of
// them meet. Returns true if there are cluster pairs to confirm.
bool find_direction_and_cull(PairRecord& record, const Body& a, const Body& b, const Settings& settings,
                             narrowphase::EmbreeDevice& device, PairWork& work);

// Stage 6 in the calling thread: the facet pairs of `work`, into its record.
void confirm(PairWork& work);

// Stage 6 with the cluster pairs cut into ranges, for a pair too large for one thread.
void confirm_in_ranges(PairWork& work, std::vector<PairWork>& thread_work, int threads);

// Is the pair large enough for confirm_in_ranges to pay? Depends on the pair alone.
bool is_large(const PairWork& work);

}  // namespace tact

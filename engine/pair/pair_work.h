// Stages 3 to 6 for one pair of bodies. Reads the two bodies, writes the pair's record and nothing else.
#pragma once

#include <memory>
#include <vector>

#include "engine/base/key_sort.h"
#include "engine/base/timer.h"
#include "engine/bodies.h"
#include "engine/pair/pair_record.h"
#include "narrowphase/depth/smallest_separation.h"
#include "narrowphase/direction/minkowski_face.h"
#include "narrowphase/hull/minkowski_difference.h"
#include "narrowphase/triangles/confirm.h"

namespace tact {

// A part of stage 6 of a large pair: when and by which thread, and what was found.
struct ConfirmedRange {
  int thread = 0;
  TraceEvent::Time begin, end;
  std::vector<FacetPair> found;
  narrowphase::ConfirmCounts counts;
  std::vector<narrowphase::OpenedCluster> opened_a, opened_b;
};

// A pair between the criteria and the confirmation, and the memory for both; reused from pair to pair.
struct PairWork {
  PairRecord* record = nullptr;
  narrowphase::ConfirmInput input;
  narrowphase::KeptClusters kept_a, kept_b;
  std::vector<narrowphase::ClusterPair> cluster_pairs;
  std::vector<narrowphase::Point2> zone_points;
  narrowphase::ClusterPairWork cluster_pair_work;
  narrowphase::FaceFinder faces;
  narrowphase::SmallestMemory smallest;
  bool asks_ahead = true;          // for the memory of facets: see Bodies::stay_in_cache()
  bool surface_is_placed = false;  // smallest.surface is the record's, where the bodies are now
  narrowphase::CullCounts cull_a, cull_b;
  narrowphase::FacetPairSearch search;
  base::KeySorter sorter;
  std::vector<ConfirmedRange> ranges;  // of a large pair, from `ranges_begin` on; `range_count` of them are in use
  std::size_t range_count = 0;
  std::vector<char> seen_b;  // by cluster of kept_b
  TraceEvent::Time ranges_begin;
};

// Stages 3 to 5: do the hulls overlap, in which direction and how deep, which clusters are left, and which pairs of
// them meet. Returns true if there are cluster pairs to confirm. `timer` is the thread's, and runs from pair to pair.
// Hulls that are apart by less than `reach`, the sum of the margins, are near.
bool find_direction_and_cull(PairRecord& record, const Body& a, const Body& b, double reach, const Settings& settings,
                             narrowphase::EmbreeDevice& device, PairWork& work, base::Timer& timer);

// Stage 6 in the calling thread: the facet pairs of `work`, into its record.
void confirm(PairWork& work, base::Timer& timer);

// Stage 6 with the cluster pairs cut into ranges, for a pair too large for one thread.
void confirm_in_ranges(PairWork& work, std::vector<PairWork>& thread_work, int threads);

// Does it pay to cut the pair into ranges, one of `pairs` that a step looks at?
bool is_large(const PairWork& work, std::size_t pairs, int threads);

}  // namespace tact

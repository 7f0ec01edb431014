// Stage 6: the facet pairs of a pair that meet, in the calling thread or, if there is much to do, on all threads.
#pragma once

#include <span>
#include <vector>

#include "engine/pair/pair_work.h"

namespace tact {

/// A range of the cluster pairs of a large pair: when and by which thread it was searched, and what was found.
struct ConfirmedRange {
  int thread = 0;
  TraceEvent::Time begin, end;
  std::vector<FacetPair> found;
  narrowphase::ConfirmCounts counts;
  std::vector<narrowphase::OpenedCluster> opened_a, opened_b;
};

/// A pair that is put aside for all threads.
struct LargePair {
  CulledPair culled;
  TraceEvent::Time begin;
  std::vector<ConfirmedRange> ranges;  ///< memory of earlier pairs; `range_count` of them are this one's
  std::size_t range_count = 0;
  std::vector<char> seen_b;  ///< scratch, by kept cluster of B

  std::span<const ConfirmedRange> used_ranges() const { return std::span(ranges).first(range_count); }
};

/// The facet pairs of `work.culled`, sorted, and the numbers of kept facets, into its record.
void confirm(const base::Tuning& tuning, PairWork& work);

/// Are these so few pairs for a step that a thread may be left with nothing to do?
bool is_few(std::size_t pairs, int threads, const base::Tuning& tuning);

/// Does it pay to share out the pair among threads, one of `pairs` pairs that a step looks at?
bool is_large(const CulledPair& culled, std::size_t pairs, int threads, const base::Tuning& tuning);

/// The same answer as confirm(), with the cluster pairs cut into ranges. `thread_work` lends a PairWork to each thread;
/// that of the calling one counts.
void confirm_in_ranges(LargePair& large, std::span<PairWork> thread_work, int threads, const base::Tuning& tuning);

}  // namespace tact

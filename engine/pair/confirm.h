// Stage 6: the facet pairs of a pair that meet, in the calling thread or, if there is much to do, on all threads.
#pragma once

#include <vector>

#include "engine/pair/pair_work.h"
#include "engine/shared_work.h"

namespace tact {

/// Of a range of the cluster pairs of a large pair: when and by which thread it was searched, and what was found.
struct ConfirmedRange {
  int thread = 0;
  TraceEvent::Time begin, end;
  std::vector<FacetPair> found;
  narrowphase::ConfirmCounts counts;
  std::vector<narrowphase::OpenedCluster> opened_a, opened_b;
};

using LargePairs = SharedWork<CulledPair, ConfirmedRange>;

/// Microseconds that a pair of clusters takes (tact-bench clusters).
inline constexpr std::size_t kConfirmCost = 1;

/// The facet pairs of `work.culled`, sorted, and the numbers of kept facets, into its record.
void confirm(const base::Tuning& tuning, PairWork& work);

/// Searches a range of a large pair. All of them together, and gather_ranges(), give the answer of confirm().
void confirm_range(const CulledPair& culled, LargePairs::Range& range, const base::Tuning& tuning, int thread,
                   PairWork& work);

/// Puts what the ranges found into the record.
void gather_ranges(const LargePairs& large, LargePairs::Shared& pair, const base::Tuning& tuning, int threads,
                   PairWork& work);

}  // namespace tact

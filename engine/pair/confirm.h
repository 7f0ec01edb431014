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
  std::vector<ConfirmedRange> ranges;  ///< memory of earlier pairs; `range_count` of them are this one's
  std::size_t range_count = 0;
  std::size_t next_range = 0, end_range = 0;  ///< no thread has taken those between
  TraceEvent::Time end;                       ///< when all that was found stood in the record
  std::vector<char> seen_b;                   ///< scratch, by kept cluster of B

  /// Into ranges that no thread has taken yet.
  void cut(int threads, const base::Tuning& tuning);
  std::span<const ConfirmedRange> used_ranges() const { return std::span(ranges).first(range_count); }
};

/// The facet pairs of `work.culled`, sorted, and the numbers of kept facets, into its record.
void confirm(const base::Tuning& tuning, PairWork& work);

/// Whether a step has so few pairs that a thread may be left with nothing to do.
bool is_few(std::size_t pairs, int threads, const base::Tuning& tuning);

/// Whether sharing out the pair among threads pays, one of `pairs` pairs that a step looks at.
bool is_large(const CulledPair& culled, std::size_t pairs, int threads, const base::Tuning& tuning);

/// Searches the i-th range. All of them together, and gather_ranges(), give the answer of confirm().
void confirm_range(LargePair& large, std::size_t i, const base::Tuning& tuning, int thread, PairWork& work);

/// Puts what the ranges found into the record.
void gather_ranges(LargePair& large, const base::Tuning& tuning, int threads, PairWork& work);

}  // namespace tact

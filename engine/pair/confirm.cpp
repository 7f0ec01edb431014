#include "engine/pair/confirm.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/base/timer.h"
#include "engine/pair/facet_pair_sort.h"

namespace tact {

namespace {

using namespace narrowphase;

constexpr std::size_t kRangesPerThread = 4;  // of large pairs, so that threads end together

// What the criteria did to the facets of the clusters of either body that were opened.
struct OpenedFacets {
  CullCounts a, b;
};

void finish(const CulledPair& culled, OpenedFacets opened, const ConfirmCounts& confirmed, int threads,
            PairWork& work) {
  if (culled.swapped) {
    std::swap(opened.a, opened.b);
    for (FacetPair& pair : culled.record->facet_pairs) std::swap(pair.a, pair.b);
  }
  sort_facet_pairs(culled.record->facet_pairs, culled.a->facet_count(), culled.b->facet_count(), work.sorter, threads);
  if (culled.history != nullptr) culled.history->finish(confirmed.still_apart);
  culled.record->contact.kept_facets_a = opened.a.kept;
  culled.record->contact.kept_facets_b = opened.b.kept;
  work.counts.cull += opened.a;
  work.counts.cull += opened.b;
  work.counts.confirm += confirmed;
}

// Where the i-th of `count` ranges begins: between two clusters of A.
std::size_t range_begin(const std::vector<ClusterPair>& pairs, std::size_t i, std::size_t count) {
  std::size_t begin = pairs.size() * i / count;
  while (begin > 0 && begin < pairs.size() && pairs[begin].a == pairs[begin - 1].a) ++begin;
  return begin;
}

// Equally many for each thread that has enough to do.
std::size_t count_of_ranges(std::size_t pairs, int threads, std::size_t fewest) {
  const std::size_t at_once = std::clamp<std::size_t>(pairs / fewest, 1, static_cast<std::size_t>(threads));
  return at_once * std::clamp<std::size_t>(pairs / (2 * fewest * at_once), 1, kRangesPerThread);
}

// A cluster of B that several ranges opened counts once.
OpenedFacets opened_in_ranges(LargePair& large, const base::Tuning& tuning) {
  OpenedFacets opened;
  large.seen_b.assign(large.culled.confirm_input(tuning).kept_b->count(), false);
  for (const ConfirmedRange& range : large.used_ranges()) {
    for (const OpenedCluster& one : range.opened_a) opened.a += one.counts;
    for (const OpenedCluster& one : range.opened_b) {
      if (!std::exchange(large.seen_b[one.index], true)) opened.b += one.counts;
    }
  }
  return opened;
}

}  // namespace

void confirm(const base::Tuning& tuning, PairWork& work) {
  const CulledPair& culled = work.culled;
  ConfirmCounts confirmed;
  work.search.run(culled.confirm_input(tuning), culled.cluster_pairs, 0, culled.cluster_pairs.size(),
                  culled.record->facet_pairs, confirmed);
  OpenedFacets opened;
  for (const OpenedCluster& one : work.search.opened_a()) opened.a += one.counts;
  for (const OpenedCluster& one : work.search.opened_b()) opened.b += one.counts;
  finish(culled, opened, confirmed, 1, work);
}

bool is_few(std::size_t pairs, int threads, const base::Tuning& tuning) {
  return pairs < tuning.few_pairs_per_thread * static_cast<std::size_t>(threads);
}

bool is_large(const CulledPair& culled, std::size_t pairs, int threads, const base::Tuning& tuning) {
  if (threads == 1) return false;
  return culled.cluster_pairs.size() > (is_few(pairs, threads, tuning) ? tuning.large_of_few : tuning.large_pair);
}

void LargePair::cut(int threads, const base::Tuning& tuning) {
  range_count = count_of_ranges(culled.cluster_pairs.size(), threads, tuning.fewest_in_range);
  next_range = 0;
  end_range = range_count;
  if (ranges.size() < range_count) ranges.resize(range_count);
}

void confirm_range(LargePair& large, std::size_t i, const base::Tuning& tuning, int thread, PairWork& work) {
  const std::vector<ClusterPair>& pairs = large.culled.cluster_pairs;
  ConfirmedRange& range = large.ranges[i];
  range.thread = thread;
  range.begin = base::Timer::Clock::now();
  range.found.clear();
  range.counts = {};
  work.search.run(large.culled.confirm_input(tuning), pairs, range_begin(pairs, i, large.range_count),
                  range_begin(pairs, i + 1, large.range_count), range.found, range.counts);
  range.opened_a = work.search.opened_a();
  range.opened_b = work.search.opened_b();
  range.end = base::Timer::Clock::now();
  work.counts.confirm_ms += std::chrono::duration<double, std::milli>(range.end - range.begin).count();
}

void gather_ranges(LargePair& large, const base::Tuning& tuning, int threads, PairWork& work) {
  base::Timer timer;
  PairRecord& record = *large.culled.record;
  ConfirmCounts confirmed;
  for (const ConfirmedRange& range : large.used_ranges()) {
    record.facet_pairs.insert(record.facet_pairs.end(), range.found.begin(), range.found.end());
    confirmed += range.counts;
  }
  finish(large.culled, opened_in_ranges(large, tuning), confirmed, threads, work);
  work.counts.confirm_ms += timer.lap();
  large.end = timer.start();
}

}  // namespace tact

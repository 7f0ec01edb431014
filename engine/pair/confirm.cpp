#include "engine/pair/confirm.h"

#include <chrono>
#include <utility>

#include "engine/base/timer.h"
#include "engine/pair/facet_pair_sort.h"

namespace tact {

namespace {

using namespace narrowphase;

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
  split_off_bare(*culled.a, *culled.b, culled.record->facet_pairs, culled.record->bare_pairs);
  if (culled.history != nullptr) culled.history->finish(confirmed.still_apart);
  if (culled.as_surfaces && culled.record->surfaces != nullptr) culled.record->surfaces->weigh(confirmed);
  culled.record->contact.kept_facets_a = opened.a.kept_of_surface();
  culled.record->contact.kept_facets_b = opened.b.kept_of_surface();
  work.counts.cull += opened.a;
  work.counts.cull += opened.b;
  work.counts.confirm += confirmed;
}

// A cluster of B that several ranges opened counts once.
OpenedFacets opened_in_ranges(const LargePairs& large, const LargePairs::Shared& pair, const base::Tuning& tuning,
                              std::vector<char>& seen_b) {
  OpenedFacets opened;
  seen_b.assign(pair.item.confirm_input(tuning).kept_b->count(), false);
  for (const LargePairs::Range& range : large.ranges(pair)) {
    for (const OpenedCluster& one : range.found.opened_a) opened.a += one.counts;
    for (const OpenedCluster& one : range.found.opened_b) {
      if (!std::exchange(seen_b[one.index], true)) opened.b += one.counts;
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

void confirm_range(const CulledPair& culled, LargePairs::Range& range, const base::Tuning& tuning, int thread,
                   PairWork& work) {
  ConfirmedRange& found = range.found;
  found.thread = thread;
  found.begin = base::Timer::Clock::now();
  found.found.clear();
  found.counts = {};
  work.search.run(culled.confirm_input(tuning), culled.cluster_pairs, range.begin, range.end, found.found,
                  found.counts);
  found.opened_a = work.search.opened_a();
  found.opened_b = work.search.opened_b();
  found.end = base::Timer::Clock::now();
  work.counts.confirm_ms += std::chrono::duration<double, std::milli>(found.end - found.begin).count();
}

void gather_ranges(const LargePairs& large, LargePairs::Shared& pair, const base::Tuning& tuning, int threads,
                   PairWork& work) {
  base::Timer timer;
  PairRecord& record = *pair.item.record;
  ConfirmCounts confirmed;
  for (const LargePairs::Range& range : large.ranges(pair)) {
    record.facet_pairs.insert(record.facet_pairs.end(), range.found.found.begin(), range.found.found.end());
    confirmed += range.found.counts;
  }
  finish(pair.item, opened_in_ranges(large, pair, tuning, work.seen_b), confirmed, threads, work);
  work.counts.confirm_ms += timer.lap();
  pair.item.end = timer.start();
}

}  // namespace tact

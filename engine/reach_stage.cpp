#include "engine/reach_stage.h"

#include <algorithm>

namespace tact {

namespace {

// Microseconds that a pair of clusters takes.
constexpr std::size_t kReachCost = 8;
// Pairs that a thread puts into their places at a time, at some 20 ns each.
constexpr std::size_t kReachPairsAtATime = 2048;

void search(const narrowphase::ContactPointSearch::Given given, const Bodies& bodies, const auto& wanted,
            std::span<const narrowphase::ClusterPair> pairs, auto& work, std::vector<ReachPair>& found) {
  found.clear();
  work.search.run_within_reach(bodies.featured(wanted.a), bodies.featured(wanted.b), wanted.reach, pairs, found, given);
}

void publish(const std::vector<ReachPair>& found, const Bodies& bodies, const auto& wanted, int threads, auto& work) {
  put_in_order(found, bodies.in_slot(wanted.a).mesh.source_vertex_count(), kReachPairsAtATime, threads, work.order,
               *wanted.pairs, [](const ReachPair& pair) { return pair; });
}

}  // namespace

void ReachStage::list(std::span<const MovedPair> moved, std::span<SelfRecord* const> selves, const Bodies& bodies) {
  wanted_.clear();
  slots_.clear();
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::vector<ReachPair>& pairs) {
    const double reach = bodies.reach(a, b);
    if (!(reach > 0.0) || bodies.in_slot(a).plane != nullptr || bodies.in_slot(b).plane != nullptr) return;
    wanted_.push_back({a, b, reach, &pairs});
    slots_.insert(slots_.end(), {a, b});
  };
  for (const MovedPair& pair : moved) {
    PairRecord& record = *pair.record;
    if (in_contact(record)) add(record.a.index, record.b.index, record.within_reach);
  }
  for (SelfRecord* const one : selves) add(one->body.index, one->body.index, one->within_reach);
}

// A large one is put aside when it is known what is near.
void ReachStage::find_one(std::size_t i, const Bodies& bodies, const Settings& settings,
                          narrowphase::EmbreeDevice& device, Work& work) {
  if (work.prepared == nullptr) work.prepared = std::make_unique<Prepared>();
  Prepared& prepared = *work.prepared;
  const Wanted& wanted = wanted_[i];
  prepared.wanted = &wanted;
  prepared.cluster_pairs =
      prepared.near.find({.mesh = bodies.featured(wanted.a).mesh}, {.mesh = bodies.featured(wanted.b).mesh},
                         wanted.reach, bodies.tuning(), device);
  const std::size_t cost = kReachCost * prepared.cluster_pairs.size();
  if (is_large(cost, wanted_.size(), settings.threads, bodies.tuning())) {
    large_.put_aside(work.prepared, prepared.cluster_pairs, count_of_ranges(cost, settings.threads, bodies.tuning()));
    return;
  }
  search(narrowphase::ContactPointSearch::Given::all, bodies, wanted, prepared.cluster_pairs, work, work.found);
  publish(work.found, bodies, wanted, 1, work);
}

void ReachStage::find(std::span<const MovedPair> moved, std::span<SelfRecord* const> selves, Bodies& bodies,
                      const Settings& settings, narrowphase::EmbreeDevice& device) {
  list(moved, selves, bodies);
  bodies.make_features(slots_, settings.threads);
  work_.resize(settings.threads);
  const auto facets_of = [&](std::size_t i) {
    return std::min(bodies.in_slot(wanted_[i].a).mesh.facet_count(), bodies.in_slot(wanted_[i].b).mesh.facet_count());
  };
  const auto search_range = [&](const Large::Shared& shared, Large::Range& range, int thread) {
    const Prepared& prepared = *shared.item;
    search(narrowphase::ContactPointSearch::Given::some, bodies, *prepared.wanted,
           prepared.cluster_pairs.subspan(range.begin, range.end - range.begin), work_[thread], range.found);
  };
  large_.begin();
  large_.prepare(
      wanted_.size(), items_at_a_time(wanted_.size(), settings.threads, bodies.tuning(), facets_of), settings.threads,
      is_few(wanted_.size(), settings.threads, bodies.tuning()),
      [&](std::size_t i, int thread) { find_one(i, bodies, settings, device, work_[thread]); }, search_range);
  large_.search(settings.threads, search_range);
  large_.gather(settings.threads, [&](Large::Shared& shared, int thread, int threads) {
    Work& work = work_[thread];
    large_.collect(shared, work.found);
    publish(work.found, bodies, *shared.item->wanted, threads, work);
  });
}

}  // namespace tact

#include "engine/pair/cull.h"

#include <functional>

namespace tact {

namespace {

using namespace narrowphase;

ZoneDisk zone_disk(const Slab& slab, const ImpactZone& zone, double height) {
  if (zone.disk.radius < 0.0) return {};
  const base::Vec3 center = slab.origin + zone.disk.center.x * slab.u + zone.disk.center.y * slab.v + height * slab.n;
  return {{center.x, center.y, center.z}, zone.disk.radius};
}

void find_criteria(const PairTask& pair, const Slab& slab) {
  PairWork& work = pair.work;
  const bool paper = pair.settings.accuracy == Accuracy::paper;
  const bool zones = paper || pair.settings.outputs.zones;
  ImpactZone zone_a, zone_b;
  if (zones) {
    zone_a = impact_zone(pair.a.mesh, slab, work.zone_points);
    zone_b = impact_zone(pair.b.mesh, slab, work.zone_points);
    pair.record.contact.zone_a = zone_disk(slab, zone_a, slab.lower);
    pair.record.contact.zone_b = zone_disk(slab, zone_b, slab.upper);
  }
  work.culled.criteria_a = criteria_for_a(slab, zones ? &zone_b : nullptr, paper && pair.a.has_inside);
  work.culled.criteria_b = criteria_for_b(slab, zones ? &zone_a : nullptr, paper && pair.b.has_inside);
}

void count_clusters(const CulledPair& culled, PairCounts& counts) {
  const std::int64_t clusters = culled.a->cluster_count() + culled.b->cluster_count();
  const std::int64_t outside_slab = culled.kept_a.too_low + culled.kept_b.too_low;
  counts.facets += culled.a->facet_count() + culled.b->facet_count();
  counts.clusters += clusters;
  counts.clusters_outside_slab += outside_slab;
  counts.clusters_outside_box += clusters - outside_slab - culled.kept_a.count() - culled.kept_b.count();
  counts.cluster_pairs += static_cast<std::int64_t>(culled.cluster_pairs.size());
}

// Surfaces that lie on each other: that with more clusters is A, whose clusters are looked at one after the other. Of
// what only planes tell apart, `near` are the pairs whose boxes overlap: where boxes tell little, facets are slivers,
// of which floats leave most pairs open.
void prepare_surfaces(const PairTask& pair, std::size_t near) {
  PairRecord& record = pair.record;
  PairWork& work = pair.work;
  CulledPair& culled = work.culled;
  culled.swapped = false;
  culled.history = nullptr;
  const bool zones = pair.settings.accuracy == Accuracy::paper || pair.settings.outputs.zones;
  culled.as_surfaces = !zones && worth_as_surfaces(culled.confirm_input(pair.tuning), near);
  culled.as_surfaces = culled.as_surfaces && (record.surfaces == nullptr || record.surfaces->takes_as_surfaces());
  if (!culled.as_surfaces) return;
  culled.swapped = culled.kept_a.count() < culled.kept_b.count();
  if (culled.swapped) work.join.exchange_meshes(culled.cluster_pairs, culled.kept_b.count());
  if (!pair.tuning.carries_surfaces) return;
  if (record.surfaces == nullptr) record.surfaces = std::make_unique<SurfaceHistory>();
  SurfaceHistory& history = *record.surfaces;
  if (history.start(culled.confirm_input(pair.tuning), culled.cluster_pairs)) culled.history = &history;
  if (history.wants_travel_of_a()) work.keep_travel.push_back(culled.swapped ? record.b : record.a);
  if (history.wants_travel_of_b()) work.keep_travel.push_back(culled.swapped ? record.a : record.b);
}

}  // namespace

void cull(const PairTask& pair, const Slab& slab, EmbreeDevice& device) {
  const ClusteredMesh &a = pair.a.mesh, &b = pair.b.mesh;
  PairWork& work = pair.work;
  CulledPair& culled = work.culled;
  culled.record = &pair.record;
  culled.a = &a;
  culled.b = &b;
  find_criteria(pair, slab);
  // Without prefetching the facets the piles of tact-bench rivals take 3 to 9 % longer.
  cull_clusters(a, culled.criteria_a, b.box(), culled.kept_a);
  if (work.prefetches) prefetch_facets(a, culled.kept_a);
  cull_clusters(b, culled.criteria_b, culled.kept_a.bounds, culled.kept_b);
  if (work.prefetches) prefetch_facets(b, culled.kept_b);
  keep_again(culled.kept_b.bounds, culled.kept_a);
  work.join.run(culled.kept_a, culled.kept_b, BoxPairs::all, pair.tuning, device, culled.cluster_pairs);
  const std::size_t near = culled.cluster_pairs.size();
  const auto paired = [](const ClusteredMesh& mesh, const KeptClusters& kept) {
    return PairedClusters{{.mesh = &mesh}, kept.count(), kept.cluster.data()};
  };
  work.separation.leave_out(paired(a, culled.kept_a), paired(b, culled.kept_b), 0.0, pair.tuning, culled.cluster_pairs,
                            std::identity{});
  work.counts.tree_pairs += work.join.uses_trees() ? 1 : 0;
  count_clusters(culled, work.counts);
  prepare_surfaces(pair, near);
}

}  // namespace tact

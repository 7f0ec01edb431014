#include "narrowphase/pairs/kept_clusters.h"

#include "narrowphase/mesh/chosen_groups.h"
#include "narrowphase/mesh/prefetch.h"
#include "narrowphase/pairs/box_reach.h"

namespace tact::narrowphase {

namespace {

// The facets of so many clusters, some 1.5 kB each, are prefetched; to prefetch more costs more than it saves.
constexpr std::size_t kMostPrefetched = 64;

// Those of `count` boxes from `first` on that meet `near`, where they are or on their way from `begin`.
int select(const ClusterBoxes& from, BoxView last, const BoxView* begin, int first, int count, const Box& near,
           std::int32_t* chosen) {
  if (begin == nullptr) return kernels().select_overlapping(last.pointers(first), count, bounds_of(near), chosen);
  if (!from.has_frame())
    return kernels().select_swept(begin->pointers(first), last.pointers(first), count, bounds_of(near), chosen);
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(first + i);
    if (overlaps(merged((*begin)[k], seen_from(from.way->frame, last[k])), near)) chosen[found++] = i;
  }
  return found;
}

}  // namespace

void keep_clusters(const ClusterBoxes& from, double reach, const Box& other, KeptClusters& kept) {
  const ClusteredMesh& mesh = *from.mesh;
  const BoxView *const begin_groups = from.way == nullptr ? nullptr : &from.way->begin->group_boxes,
                       *const begin_clusters = from.way == nullptr ? nullptr : &from.way->begin->cluster_boxes;
  // The boxes that meet `other` when they are grown meet this, whatever rounds.
  const Box near = reach > 0.0 ? inflated(other, box_reach(reach, largest_coordinate(other))) : other;
  kept.cluster.clear();
  kept.too_low = 0;
  const auto select_groups = [&](int begin, int count, std::int32_t* chosen) {
    return select(from, from.end_group_boxes(), begin_groups, begin, count, near, chosen);
  };
  for_chosen_groups(mesh, select_groups, [&](int group) {
    const int begin = mesh.cluster_begin(group), count = mesh.cluster_end(group) - begin;
    std::int32_t chosen[kGroupSize];
    int found;
    if (from.least_height != nullptr) {
      const CullPlanes planes{
          .axis = from.least_height->axis, .lowest = from.least_height->lowest, .box = bounds_of(near)};
      const Culled culled = kernels().cull_boxes(mesh.cluster_boxes().pointers(begin), count, planes, chosen);
      found = culled.left;
      kept.too_low += culled.low;
    } else {
      found = select(from, from.end_boxes(), begin_clusters, begin, count, near, chosen);
    }
    for (int i = 0; i < found; ++i) kept.cluster.push_back(begin + chosen[i]);
  });
  kept.boxes.resize(kept.cluster.size());
  kept.bounds = {};
  for (std::size_t i = 0; i < kept.cluster.size(); ++i) {
    const Box box = reach > 0.0 ? inflated(from[kept.cluster[i]], reach) : from[kept.cluster[i]];
    kept.boxes.set(i, box);
    kept.bounds = merged(kept.bounds, intersection(box, other));
  }
}

void keep_again(const Box& other, KeptClusters& kept) {
  std::size_t found = 0;
  Box bounds;
  for (std::size_t i = 0; i < kept.cluster.size(); ++i) {
    const Box box = kept.boxes[i];
    if (!overlaps(box, other)) continue;
    bounds = merged(bounds, intersection(box, other));
    kept.cluster[found] = kept.cluster[i];
    kept.boxes.set(found++, box);
  }
  kept.bounds = bounds;
  kept.cluster.resize(found);
}

void prefetch_facets(const ClusteredMesh& mesh, const KeptClusters& kept) {
  if (kept.cluster.size() > kMostPrefetched) return;
  for (const std::int32_t cluster : kept.cluster) prefetch_facets(mesh, cluster);
}

}  // namespace tact::narrowphase

// From the boxes of groups to those of clusters: the clusters that a query wants to open, best first or all in a
// box.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/box_arrays.h"
#include "narrowphase/mesh/chosen_groups.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

inline Box box_of(const Triangle& t) { return extended(extended(Box{t[0], t[0]}, t[1]), t[2]); }

/// Calls take(index) for entries of a list by ascending rank, as long as wants(rank), which take may narrow. The list
/// is used up. Most entries drop out after the first was taken, so that sorting them all would cost more.
template <class Index, class Wants, class Take>
void take_by_rank(double* rank, Index* index, int count, const Wants& wants, const Take& take) {
  while (count > 0) {
    int left = 0, best = 0;
    for (int i = 0; i < count; ++i) {
      if (!wants(rank[i])) continue;
      rank[left] = rank[i];
      index[left] = index[i];
      if (rank[left] < rank[best]) best = left;
      ++left;
    }
    if (left == 0) return;
    const Index taken = index[best];
    count = left - 1;
    rank[best] = rank[count];
    index[best] = index[count];
    take(taken);
  }
}

/// What for_each_cluster_by_rank() is to leave out: nothing.
struct SkipNone {
  static bool group(int) { return false; }
  static bool cluster(int) { return false; }
};

/// Calls open(cluster) by ascending rank within a group, and groups by theirs, but for those that skips.group() or
/// skips.cluster() names. rank(boxes, count, ranked) fills `ranked` with those of up to RankedBoxes::kMost boxes that
/// are wanted; wants(rank) tells whether one still is.
template <class Rank, class Wants, class Open, class Skips = SkipNone>
void for_each_cluster_by_rank(const ClusteredMesh& mesh, const Rank& rank, const Wants& wants, const Open& open,
                              const Skips& skips = {}) {
  RankedBoxes groups, clusters;
  const auto open_group = [&](int group) {
    if (skips.group(group)) return;
    const int begin = mesh.cluster_begin(group);
    rank(mesh.cluster_boxes().pointers(begin), mesh.cluster_end(group) - begin, clusters);
    if constexpr (!std::is_same_v<Skips, SkipNone>) {
      int left = 0;
      for (int i = 0; i < clusters.count; ++i) {
        if (skips.cluster(begin + clusters.index[i])) continue;
        clusters.rank[left] = clusters.rank[i];
        clusters.index[left++] = clusters.index[i];
      }
      clusters.count = left;
    }
    take_by_rank(clusters.rank, clusters.index, clusters.count, wants, [&](int c) { open(begin + c); });
  };
  const int count = mesh.group_count();
  if (count == 1) return open_group(0);
  for (int first = 0; first < count; first += RankedBoxes::kMost) {
    rank(mesh.group_boxes().pointers(first), std::min(count - first, RankedBoxes::kMost), groups);
    take_by_rank(groups.rank, groups.index, groups.count, wants, [&](int g) { open_group(first + g); });
  }
}

/// Calls open(cluster) for those whose box overlaps `box`, ascending.
template <class Open>
void for_each_cluster_in(const ClusteredMesh& mesh, const Box& box, const Open& open) {
  if (mesh.facet_count() == 0) return;
  const BoxBounds bounds = bounds_of(box);
  const auto select = [&](int begin, int count, std::int32_t* chosen) {
    return kernels().select_overlapping(mesh.group_boxes().pointers(begin), count, bounds, chosen);
  };
  for_chosen_groups(mesh, select, [&](int group) {
    const int begin = mesh.cluster_begin(group);
    std::int32_t chosen[kGroupSize];
    const int count = kernels().select_overlapping(mesh.cluster_boxes().pointers(begin),
                                                   mesh.cluster_end(group) - begin, bounds, chosen);
    for (int k = 0; k < count; ++k) open(begin + chosen[k]);
  });
}

}  // namespace tact::narrowphase

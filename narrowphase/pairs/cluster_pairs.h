// What is near: the pairs of clusters of two meshes, or of one with itself, whose boxes overlap.
// Boxes are those of the clusters where they are, grown by a reach, or swept along the ways of their vertices. Of each
// mesh the clusters near the other are kept first (kept_clusters.h), then joined (cluster_join.h). Of what is still,
// planes leave out more where boxes tell little (cluster_separation.h).
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "narrowphase/pairs/box_reach.h"
#include "narrowphase/pairs/cluster_join.h"
#include "narrowphase/pairs/cluster_separation.h"

namespace tact::narrowphase {

/// Its memory is used again: one for each thread.
class ClusterPairFinder {
 public:
  /// The pairs whose boxes come within `reach` (metres) of each other, but for those of two clusters that are still
  /// and that a plane separates as far, sorted. Of one mesh, for which both boxes are the same,
  /// each pair once, the smaller cluster first, each cluster with itself among them. Valid until the next call. Errors:
  /// those of ClusterForest::build().
  std::span<const ClusterPair> find(const ClusterBoxes& a, const ClusterBoxes& b, double reach,
                                    const base::Tuning& tuning, EmbreeDevice& device) {
    const Box box_a = a.box(), box_b = b.box();
    keep_clusters(a, box_reach(reach, std::max(largest_coordinate(box_a), largest_coordinate(box_b))), box_b, kept_a_);
    keep_clusters(b, 0.0, kept_a_.bounds, kept_b_);
    join_.run(kept_a_, kept_b_, a.mesh == b.mesh ? BoxPairs::ascending : BoxPairs::all, tuning, device, pairs_);
    for (ClusterPair& pair : pairs_) pair = {kept_a_.cluster[pair.a], kept_b_.cluster[pair.b]};
    if (a.way == nullptr) leave_out_separated(a, b, reach, tuning, pairs_, std::identity{});
    return pairs_;
  }

  /// After find(), of those pairs that are left: leaves out items whose clusters a plane separates all the
  /// way.
  template <class Item, class PairOf>
  void leave_out_separated(const ClusterBoxes& a, const ClusterBoxes& b, double reach, const base::Tuning& tuning,
                           std::vector<Item>& items, const PairOf& pair_of) {
    separation_.leave_out({a, kept_a_.count()}, {b, kept_b_.count()}, reach, tuning, items, pair_of);
  }

 private:
  KeptClusters kept_a_, kept_b_;
  ClusterJoin join_;
  ClusterSeparation separation_;
  std::vector<ClusterPair> pairs_;
};

}  // namespace tact::narrowphase

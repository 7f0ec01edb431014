// Which clusters of two meshes, or of one twice, have boxes that overlap: whatever boxes they are given.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/triangles/confirm.h"

namespace tact::narrowphase {

/// One for each thread, its memory used again.
class ClusterPairFinder {
 public:
  /// box_of_a(c) and box_of_b(c) give the boxes of the clusters c; all of b's lie in `all_of_b`. Sorted. Of one mesh,
  /// where box_of_a(c) holds box_of_b(c), each pair once, the smaller cluster first. Valid until the next call. Errors:
  /// those of find_cluster_pairs().
  template <class BoxOfA, class BoxOfB>
  std::span<const ClusterPair> find(const ClusteredMesh& a, const BoxOfA& box_of_a, const ClusteredMesh& b,
                                    const BoxOfB& box_of_b, const Box& all_of_b, const base::Tuning& tuning,
                                    EmbreeDevice& device) {
    keep(a, box_of_a, all_of_b, kept_a_);
    keep(b, box_of_b, kept_a_.bounds, kept_b_);
    find_cluster_pairs(kept_a_, kept_b_, tuning, device, pairs_, work_, &a == &b ? BoxPairs::ascending : BoxPairs::all);
    for (ClusterPair& pair : pairs_) pair = {kept_a_.cluster[pair.a], kept_b_.cluster[pair.b]};
    return pairs_;
  }

 private:
  template <class BoxOf>
  static void keep(const ClusteredMesh& mesh, const BoxOf& box_of, const Box& other, KeptClusters& kept) {
    kept.cluster.clear();
    kept.bounds = {};
    kept.boxes.resize(mesh.cluster_count());
    for (int c = 0; c < mesh.cluster_count(); ++c) {
      const Box box = box_of(c);
      if (!overlaps(box, other)) continue;
      kept.boxes.set(kept.cluster.size(), box);
      kept.cluster.push_back(c);
      kept.bounds = merged(kept.bounds, box);
    }
  }

  KeptClusters kept_a_, kept_b_;
  std::vector<ClusterPair> pairs_;
  ClusterPairWork work_;
};

}  // namespace tact::narrowphase

// Which clusters of a surface have no facet that faces a direction.
#pragma once

#include <vector>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// The boxes of the unit normals of clusters, and of groups. Buffers are reused.
class FacingClusters {
 public:
  /// Forgets all of them.
  void clear() { clusters_.clear(); }
  bool are_known() const { return !clusters_.empty(); }
  /// Takes the next cluster, in their order, by all its facets. A normal that rounding may turn counts as any.
  void add(const FacetBlock& facets, double scale);
  /// After the last one.
  void merge_groups(const ClusteredMesh& mesh);

  /// Does the kernel rank_block() certainly leave out every facet there?
  bool cluster_turned_away(int cluster, const FacingNormals& facing) const {
    return turned_away(clusters_[cluster], facing);
  }
  bool group_turned_away(int group, const FacingNormals& facing) const { return turned_away(groups_[group], facing); }

 private:
  static bool turned_away(const Box& normals, const FacingNormals& facing);

  std::vector<Box> clusters_, groups_;
};

}  // namespace tact::narrowphase

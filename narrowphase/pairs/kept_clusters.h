// The clusters of a mesh that a search keeps: those whose boxes reach the other mesh. Groups of clusters are tested
// first.
#pragma once

#include <cstdint>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// What lies lower along an axis is left out.
struct LeastHeight {
  HeightAxis axis;
  double lowest;
};

/// The boxes of a mesh's clusters as a search sees them.
struct ClusterBoxes {
  const ClusteredMesh* mesh = nullptr;
  const Placement* begin = nullptr;           // if not null, the boxes are swept: from there to where the mesh is
  const LeastHeight* least_height = nullptr;  // if not null, clusters below it are dropped; requires begin == nullptr

  Box box() const { return begin == nullptr ? mesh->box() : merged(begin->box, mesh->box()); }
  Box operator[](int cluster) const {
    const Box now = mesh->cluster_boxes()[cluster];
    return begin == nullptr ? now : merged(begin->cluster_boxes[cluster], now);
  }
};

/// Kept clusters, ascending, with their boxes.
struct KeptClusters {
  std::vector<std::int32_t> cluster;
  BoxArrays boxes;           // of the clusters in this list, in its order
  Box bounds;                // of all of them, clipped to what they were held against
  std::int64_t too_low = 0;  // clusters that the least height dropped

  int count() const { return static_cast<int>(cluster.size()); }
};

/// Keeps the clusters whose boxes, grown by `reach`, meet `other`; few that miss it by a rounding error of the reach
/// may be among them. Replaces the contents of `kept`.
void keep_clusters(const ClusterBoxes& from, double reach, const Box& other, KeptClusters& kept);
/// Drops from `kept` the clusters whose box misses `other`.
void keep_again(const Box& other, KeptClusters& kept);
/// Prefetches the facets of the kept clusters.
void prefetch_facets(const ClusteredMesh& mesh, const KeptClusters& kept);

}  // namespace tact::narrowphase

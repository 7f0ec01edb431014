// The clusters of a mesh that a search keeps: those whose boxes reach the other mesh. Groups of clusters are tested
// first.
#pragma once

#include <cstdint>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/pairs/box_reach.h"

namespace tact::narrowphase {

/// What lies lower along an axis is left out.
struct LeastHeight {
  HeightAxis axis;
  double lowest;
};

/// A mesh on its way, seen from what goes `frame` meanwhile.
struct MeshWay {
  const Placement* begin = nullptr;
  const Placement* end = nullptr;  // if null: where the mesh is
  Vec3 frame{};
};

/// The boxes of a mesh's clusters as a search sees them.
struct ClusterBoxes {
  const ClusteredMesh* mesh = nullptr;
  const MeshWay* way = nullptr;               // if not null, the boxes are swept
  const LeastHeight* least_height = nullptr;  // if not null, clusters below it are dropped; requires way == nullptr

  Box box() const {
    return way == nullptr ? mesh->box()
                          : merged(way->begin->box, seen_from(way->frame, way->end ? way->end->box : mesh->box()));
  }
  Box operator[](int cluster) const {
    const Box last = end_boxes()[cluster];
    return way == nullptr ? last : merged(way->begin->cluster_boxes[cluster], seen_from(way->frame, last));
  }
  bool has_frame() const { return way != nullptr && way->frame != Vec3{}; }
  BoxView end_boxes() const {
    return way == nullptr || way->end == nullptr ? mesh->cluster_boxes() : way->end->cluster_boxes;
  }
  BoxView end_group_boxes() const {
    return way == nullptr || way->end == nullptr ? mesh->group_boxes() : way->end->group_boxes;
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

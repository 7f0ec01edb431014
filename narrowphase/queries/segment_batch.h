// What many segments need of the same meshes, in floats: a tree over the facets of each. Groups of clusters, as the
// mesh has them, hold nodes of up to four clusters, nodes hold leaves of up to sixteen facets. Trees hold until
// something moves.
//
// Floats only propose: what a segment meets is decided by doubles. So it does not matter what there is in floats.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

inline constexpr int kNodesOfGroup = kGroupSize / LineNode::kClusters;

class SegmentBatch {
 public:
  /// Forgets all. From now on there are meshes of so many clusters, numbered as they stand there, and so many segments
  /// are about to be asked. For each number in meshes() make_tree() is to be called, then make_node() for each
  /// i < node_count(); several threads may do so at once.
  void begin(std::span<const int> cluster_counts, std::size_t segments);
  std::span<const std::size_t> meshes() const { return chosen_; }
  std::size_t node_count() const { return mesh_of_node_.size(); }
  void make_tree(const ClusteredMesh& mesh, std::size_t number);
  void make_node(std::size_t i);

  /// A mesh's tree, or null: as many as the segments pay for have one, first come, first served.
  const LineTree* tree(std::size_t number) const {
    return entries_[number].first_node == kNowhere ? nullptr : &entries_[number].tree;
  }

 private:
  // A node, which takes a microsecond to make, for so many segments. With 100 k facets and one segment for each of the
  // 1,575 clusters trees gain as much as they cost.
  static constexpr std::size_t kSegmentsOfNode = 4;
  static constexpr std::size_t kNowhere = ~std::size_t{0};

  struct Entry {
    const ClusteredMesh* mesh;
    std::size_t first_node;
    LineTree tree;
    std::vector<float> bounds;
  };

  std::vector<Entry> entries_;
  std::vector<std::size_t> chosen_;        // numbers of meshes
  std::vector<std::size_t> mesh_of_node_;  // likewise
  // Of all nodes, one after the other.
  std::unique_ptr<LineNode[]> nodes_;
  std::unique_ptr<LineLeaf[]> leaves_;
  std::size_t room_ = 0;
};

}  // namespace tact::narrowphase

#include "narrowphase/queries/segment_batch.h"

#include <algorithm>

#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

constexpr std::size_t kMore = 16;  // floats that a kernel reads past the end

int nodes_of(int clusters) { return (clusters + LineNode::kClusters - 1) / LineNode::kClusters; }

// The middle of the mesh, and a unit in which it reaches from -1 to 1 at most.
void set_unit(const Box& box, LineTree& tree) {
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    tree.origin[axis] = 0.5 * box.lower[axis] + 0.5 * box.upper[axis];
    largest = std::max({largest, box.upper[axis] - tree.origin[axis], tree.origin[axis] - box.lower[axis]});
  }
  tree.scale = 0.5 * unit_scale(largest);
}

// A box for each `step` of `count` boxes. Returns where they end.
float* copy_boxes(const BoxView& from, int count, int step, const LineTree& tree, float* to, LinedBoxes& boxes) {
  for (int side = 0; side < 6; ++side) {
    const int axis = side % 3;
    const double* const bound = side < 3 ? from.lower(axis) : from.upper(axis);
    boxes.bounds[side] = to;
    for (int i = 0; i < count; i += step) {
      double farthest = bound[i];
      for (int k = i + 1; k < std::min(i + step, count); ++k)
        farthest = side < 3 ? std::min(farthest, bound[k]) : std::max(farthest, bound[k]);
      *to++ = static_cast<float>((farthest - tree.origin[axis]) * tree.scale);
    }
    to += kMore;
  }
  return to;
}

// No segment enters it.
void make_empty(LineNode& node) {
  for (int side = 0; side < 6; ++side) std::fill_n(node.bounds[side], LineNode::kLeaves, side < 3 ? 2.0F : -2.0F);
}

}  // namespace

void SegmentBatch::begin(std::span<const int> cluster_counts, std::size_t segments) {
  entries_.resize(cluster_counts.size());
  chosen_.clear();
  mesh_of_node_.clear();
  for (std::size_t i = 0; i < cluster_counts.size(); ++i) {
    const auto own = static_cast<std::size_t>(nodes_of(cluster_counts[i])), before = mesh_of_node_.size();
    const bool pays = own > 0 && kSegmentsOfNode * (before + own) <= segments;
    entries_[i].first_node = pays ? before : kNowhere;
    if (!pays) continue;
    chosen_.push_back(i);
    mesh_of_node_.resize(before + own, i);
  }
  if (node_count() <= room_) return;
  room_ = 0;
  // Not by std::make_unique, which would write it all.
  nodes_.reset(new LineNode[node_count()]);                       // NOLINT(modernize-make-unique)
  leaves_.reset(new LineLeaf[node_count() * LineNode::kLeaves]);  // NOLINT(modernize-make-unique)
  room_ = node_count();
}

void SegmentBatch::make_tree(const ClusteredMesh& mesh, std::size_t number) {
  Entry& entry = entries_[number];
  LineTree& tree = entry.tree;
  entry.mesh = &mesh;
  tree.group_count = mesh.group_count();
  tree.node_count = nodes_of(mesh.cluster_count());
  tree.facet_count = mesh.facet_count();
  tree.node = &nodes_[entry.first_node];
  tree.leaf = &leaves_[entry.first_node * LineNode::kLeaves];
  set_unit(mesh.box(), tree);
  entry.bounds.resize(6 * (static_cast<std::size_t>(tree.node_count + tree.group_count) + 2 * kMore));
  float* const end = copy_boxes(mesh.cluster_boxes(), mesh.cluster_count(), LineNode::kClusters, tree,
                                entry.bounds.data(), tree.nodes);
  if (tree.group_count > 1) copy_boxes(mesh.group_boxes(), tree.group_count, 1, tree, end, tree.groups);
}

void SegmentBatch::make_node(std::size_t i) {
  const Entry& entry = entries_[mesh_of_node_[i]];
  const ClusteredMesh& mesh = *entry.mesh;
  const int begin = static_cast<int>(i - entry.first_node) * LineNode::kClusters;
  const int end = std::min(begin + LineNode::kClusters, mesh.cluster_count());
  if (end - begin < LineNode::kClusters || end == mesh.cluster_count()) make_empty(nodes_[i]);
  for (int c = begin; c < end; ++c) {
    const int first = (c - begin) * LineNode::kLeavesOfCluster;
    LineLeaf* const leaves = &leaves_[i * LineNode::kLeaves + static_cast<std::size_t>(first)];
    kernels().line_up_facets(mesh.facets_of(c), entry.tree.origin, entry.tree.scale, leaves, first, &nodes_[i]);
  }
}

}  // namespace tact::narrowphase

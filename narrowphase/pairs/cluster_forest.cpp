#include "narrowphase/pairs/cluster_forest.h"

#include <algorithm>

#include "narrowphase/pairs/box_reach.h"
#include "narrowphase/pairs/tree_builder.h"

namespace tact::narrowphase {

void ClusterForest::build(EmbreeDevice& device, BoxView boxes, int count) {
  nodes_.clear();
  roots_.clear();
  root_boxes_.clear();
  nodes_.reserve(count);
  TreeBuilder builder(device, boxes, count, nodes_);
  // Clusters are in spatial order, so a run of them is compact and a forest of trees is nearly as good as one tree.
  for (int begin = 0; begin < count; begin += kBoxesPerTree)
    roots_.push_back(builder.build(begin, std::min(begin + kBoxesPerTree, count)));
  // A node stands before its children: in reverse order, every child is ready.
  const auto box_of = [&](std::int32_t child) {
    if (child < 0) return boxes[~child];
    const TreeNode& node = nodes_[child];
    return merged(node.box[0], node.box[1]);
  };
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    for (int k = 0; k < 2; ++k) nodes_[i].box[k] = box_of(nodes_[i].child[k]);
  }
  for (const std::int32_t root : roots_) root_boxes_.push_back(box_of(root));
}

void ClusterForest::query(const Box& box, std::vector<std::int32_t>& stack, std::vector<std::int32_t>& found) const {
  stack.clear();
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    if (overlaps(root_boxes_[i], box)) stack.push_back(roots_[i]);
  }
  while (!stack.empty()) {
    const std::int32_t child = stack.back();
    stack.pop_back();
    if (child < 0) {
      found.push_back(~child);
      continue;
    }
    const TreeNode& node = nodes_[child];
    for (int k = 0; k < 2; ++k) {
      if (overlaps(node.box[k], box)) stack.push_back(node.child[k]);
    }
  }
}

}  // namespace tact::narrowphase

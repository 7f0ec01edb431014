// Trees over many boxes, for the pairs of bodies whose clusters are too many for a plain loop.
//
// Embree, or a builder of ours where it was left out, proposes the topology only; the boxes in the nodes are ours, in
// doubles, so a query reports exactly the boxes that overlap, however far from zero the bodies are. Embree's rtcCollide
// is not used: boxes there are floats, its threads are not ours, and every call allocates. As no scene is made, none of
// the ways in which scenes fail can occur: empty ones, flags that differ, boxes beyond 1.8e18, a refit of what is not a
// number.
#pragma once

#include <cstdint>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/pairs/embree_device.h"

namespace tact::narrowphase {

// An inner node has two children, each a node (>= 0) or a box (~index < 0), and the boxes of both.
struct TreeNode {
  Box box[2];
  std::int32_t child[2];
};

class ClusterForest {
 public:
  // A forest over boxes 0 <= i < count. Errors: backend_failure, out_of_memory.
  void build(EmbreeDevice& device, BoxView boxes, int count);

  // Appends, in no particular order, the indices of the boxes that overlap `box`. `stack` lends memory.
  void query(const Box& box, std::vector<std::int32_t>& stack, std::vector<std::int32_t>& found) const;

 private:
  std::vector<TreeNode> nodes_;
  std::vector<std::int32_t> roots_;
  std::vector<Box> root_boxes_;
};

}  // namespace tact::narrowphase

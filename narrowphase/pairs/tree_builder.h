// The topology of the trees of a forest: by Embree, or by medians where Embree was left out (TACT_WITH_EMBREE).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "narrowphase/pairs/cluster_forest.h"

namespace tact::narrowphase {

// Embree builds a tree of fewer boxes than this in the calling thread; above, it would wake threads of its own.
inline constexpr int kBoxesPerTree = 512;

class TreeBuilder {
 public:
  // Trees over some of `count` boxes, in `nodes`. Errors: backend_failure, out_of_memory.
  TreeBuilder(EmbreeDevice& device, BoxView boxes, int count, std::vector<TreeNode>& nodes);
  ~TreeBuilder();

  // The root of a tree over the boxes begin <= i < end, at most kBoxesPerTree of them: a node, or ~begin. It appends
  // each node before its children, and leaves their boxes open. Errors: backend_failure, out_of_memory.
  std::int32_t build(int begin, int end);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tact::narrowphase

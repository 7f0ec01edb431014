#include "narrowphase/mesh/mesh_placements.h"

#include <algorithm>
#include <utility>

namespace tact::narrowphase {

MeshPlacements::MeshPlacements(double* const (&memory)[2], const MeshCounts& counts)
    : clusters_(counts.clusters()),
      groups_(counts.groups()),
      stride_(static_cast<std::size_t>(counts.vertices)),
      now_(memory[0]),
      before_(memory[1]) {}

Placement MeshPlacements::in(const double* memory) const {
  return {{memory, memory + stride_, memory + 2 * stride_},
          cluster_boxes_in(memory),
          group_boxes_in(memory),
          box_in(memory)};
}

void MeshPlacements::keep_before(double* memory) const { std::copy_n(before_, used(), memory); }

void MeshPlacements::exchange(const Box& box) {
  std::swap(now_, before_);
  box_ = box;
}

void MeshPlacements::move_to(double* const (&memory)[2]) {
  std::copy_n(now_, used(), memory[0]);
  std::copy_n(before_, used(), memory[1]);
  now_ = memory[0];
  before_ = memory[1];
}

// From the boxes of the clusters, or of the groups if there are several.
Box MeshPlacements::box_in(const double* placement) const {
  const BoxView boxes = groups_ > 1 ? group_boxes_in(placement) : cluster_boxes_in(placement);
  return to_box(kernels().bounds(boxes.pointers(), groups_ > 1 ? groups_ : clusters_));
}

}  // namespace tact::narrowphase

// Where a mesh is and where it was. All that moves with the vertices is a *placement*, one piece of memory: x of each
// vertex, y of each, z of each; the boxes of the clusters; the boxes of the groups. A mesh has two of them: a refit
// writes the one that is not in use, then they change places.
#pragma once

#include <cstddef>

#include "narrowphase/mesh/box_arrays.h"
#include "narrowphase/mesh/mesh_memory.h"

namespace tact::narrowphase {

/// A placement as the narrow phase reads it.
struct Placement {
  PointArrays points{};
  BoxView cluster_boxes;
  BoxView group_boxes;  ///< if there are several groups
  Box box;              ///< of all facets; empty if there is none
};

class MeshPlacements {
 public:
  /// In this memory of two placements, of which the first is in use.
  MeshPlacements(double* const (&memory)[2], const MeshCounts& counts);

  Vec3 position(int vertex) const {
    const double* x = now_ + vertex;
    return {x[0], x[stride_], x[2 * stride_]};
  }
  PointArrays points() const { return {now_, now_ + stride_, now_ + 2 * stride_}; }
  /// The boxes of the clusters, borrowed vertices included; those of the groups, if there are several; that of all
  /// facets, which is empty if there is none.
  BoxView cluster_boxes() const { return cluster_boxes_in(now_); }
  BoxView group_boxes() const { return group_boxes_in(now_); }
  const Box& box() const { return box_; }

  /// Where the mesh is; and where it was before the last refit that changed it, valid until the next one.
  Placement now() const { return in(now_); }
  Placement before() const { return in(before_); }
  /// The placement that keep_before() wrote to `memory`, which is of size() doubles.
  Placement in(const double* memory) const;
  std::size_t size() const { return used() + kPadding; }
  void keep_before(double* memory) const;

  /// The two placements: the one in use, and the one that a refit writes.
  double* now_memory() const { return now_; }
  double* spare_memory() const { return before_; }
  /// The box of all facets in the spare one.
  Box spare_box() const { return box_in(before_); }
  /// Makes the spare placement the one in use; `box` is its box.
  void exchange(const Box& box);
  /// The one in use was written in place; `box` is its box.
  void set_box(const Box& box) { box_ = box; }
  /// Copies both to other memory and goes on there.
  void move_to(double* const (&memory)[2]);

 private:
  std::size_t used() const { return 3 * stride_ + 6 * static_cast<std::size_t>(clusters_ + groups_); }
  BoxView cluster_boxes_in(const double* placement) const {
    return {placement + 3 * stride_, static_cast<std::size_t>(clusters_)};
  }
  BoxView group_boxes_in(const double* placement) const {
    return {cluster_boxes_in(placement).lower(0) + 6 * static_cast<std::ptrdiff_t>(clusters_),
            static_cast<std::size_t>(groups_)};
  }
  Box box_in(const double* placement) const;

  int clusters_, groups_;
  std::size_t stride_;  // vertices
  double* now_;
  double* before_;
  Box box_;
};

}  // namespace tact::narrowphase

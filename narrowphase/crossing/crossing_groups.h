// Which facets and vertices of two bodies are of one crossing: those whose intersection curves have a facet in common,
// and what these curves cut off.
#pragma once

#include <vector>

#include "narrowphase/crossing/crossing.h"
#include "narrowphase/crossing/surface_part.h"

namespace tact::narrowphase {

/// Buffers are reused.
class CrossingGroups {
 public:
  /// Of two bodies, whose cuts have numbered patches.
  void find(const Crossing& crossing);
  /// Counted from 0, in the order of their first facet pairs.
  int count() const { return count_; }
  /// The group of a vertex of a, or of b, by the caller's number; negative if it is of none.
  int group_of(const CrossedSurface& surface, int source_vertex) const {
    return group_of_patch(surface, surface.cut.patch_of(source_vertex));
  }
  /// The same of a patch of a, or of b.
  int group_of_patch(const CrossedSurface& surface, int patch) const;
  /// The group of two features between which there is a point; negative if they are of none.
  int group_of(const FeaturePoint& point) const;

  /// Takes the facets of a group and the vertices that are past the other surface.
  void take_parts(int group, PartOfSurface& part_a, PartOfSurface& part_b) const;

 private:
  int node_of(const CrossedSurface& surface, int patch) const;

  const Crossing* crossing_ = nullptr;
  std::vector<int> parent_;  // of patches of a, then of b: see join_sets()
  std::vector<int> group_;   // of the least of each set
  int count_ = 0;
};

}  // namespace tact::narrowphase

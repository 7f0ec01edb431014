// What the crossings of two bodies remember of the last step: the mean normals of the points that they had.
//
// A crossing *keeps* its direction if it had negative gaps, and no vertex that had one is past the other surface any
// more. Then it is out on one side, while others came in on another one: each for itself would lead it to and fro, as
// where a plate is moved out of one side of a wedge and so into the other.
#pragma once

#include <vector>

#include "narrowphase/crossing/crossing.h"
#include "narrowphase/crossing/crossing_groups.h"

namespace tact::narrowphase {

/// Buffers are reused.
class KeptDirections {
 public:
  /// Whether any crossing may keep a direction. Costs less than to know which.
  static bool may_be(const Crossing& crossing);
  void find(const Crossing& crossing, const CrossingGroups& groups);
  /// From a to b, unit, of negative gaps if there are any; of a new crossing those of ended ones. Zero: nothing agrees.
  Vec3 came(int group) const;
  /// The same of a crossing that keeps its direction; zero if it does not.
  Vec3 kept(int group) const;
  /// Gives the patches of a surface what their crossings keep.
  void give(const CrossingGroups& groups, CrossedSurface& surface) const;

 private:
  struct Sum {
    Vec3 of_past, of_others;
    int past = 0, others = 0;
    bool goes_on = false;  // a vertex that had a negative gap is past the other surface still
  };
  void take(int group, Vec3 normal, double gap, bool is_past);

  std::vector<Sum> sums_;  // of groups, and of what is of none any more
};

}  // namespace tact::narrowphase

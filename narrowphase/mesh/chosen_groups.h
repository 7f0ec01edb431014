// A query of a large mesh chooses among its groups of clusters first.
#pragma once

#include <algorithm>
#include <cstdint>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

// Calls work(g) for every group g that `select` chooses, ascending; if there is only one group, for that one.
// select(int begin, int count, std::int32_t* chosen) looks at `count` groups from `begin` on, writes those that it
// chooses, counted from `begin`, and returns how many. It is called for 256 groups at a time, after work() on the
// groups before.
template <class Select, class Work>
void for_chosen_groups(const ClusteredMesh& mesh, const Select& select, const Work& work) {
  constexpr int kAtATime = 256;
  if (mesh.group_count() == 1) return work(0);
  for (int begin = 0; begin < mesh.group_count(); begin += kAtATime) {
    std::int32_t chosen[kAtATime];
    const int count = select(begin, std::min(kAtATime, mesh.group_count() - begin), chosen);
    for (int i = 0; i < count; ++i) work(begin + chosen[i]);
  }
}

}  // namespace tact::narrowphase

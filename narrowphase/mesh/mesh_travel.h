// How far the vertices of each cluster of a mesh have gone, for those who know that two clusters were apart.
#pragma once

#include <vector>

#include "narrowphase/mesh/mesh_topology.h"

namespace tact::narrowphase {

class MeshTravel {
 public:
  explicit MeshTravel(const MeshTopology& topology);

  /// Metres that any vertex of the cluster, borrowed ones included, has gone at most since this was made, all refits
  /// added up and rounded up; and what it was before the last refit. Infinite once it is too far to be told.
  double of(int cluster) const { return now_[cluster]; }
  double last_of(int cluster) const { return now_[cluster] - before_[cluster]; }

  /// Where a refit writes how far the vertices that each cluster owns went, in square metres.
  double* steps_squared() { return steps_.data(); }
  /// Adds what was written; takes that back.
  void add_steps();
  void undo() { now_.swap(before_); }

 private:
  std::vector<int> owners_begin_, owners_;  // of each cluster: the clusters that own what it borrows
  std::vector<double> now_, before_, steps_;
};

}  // namespace tact::narrowphase

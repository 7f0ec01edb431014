// Where the vertices of one cluster stand in it: those that it owns first, then those that it borrows.
#pragma once

#include <vector>

#include "narrowphase/kernels/facets.h"

namespace tact::narrowphase {

/// Of one cluster at a time; its memory is used again.
class ClusterPlaces {
 public:
  void choose(const ClusterFacets& cluster, int vertex_count) {
    forget();
    if (place_.size() != static_cast<std::size_t>(vertex_count)) place_.assign(vertex_count, -1);
    chosen_ = cluster;
    for (int i = 0; i < chosen_.borrowed_count; ++i) place_[chosen_.borrowed[i]] = chosen_.owned_count + i;
  }
  /// Before the mesh is another one, or no more.
  void forget() {
    for (int i = 0; i < chosen_.borrowed_count; ++i) place_[chosen_.borrowed[i]] = -1;
    chosen_ = {};
  }
  /// Negative if the cluster does not use the vertex.
  int operator[](int vertex) const {
    const int owned = vertex - chosen_.owned_begin;
    return owned >= 0 && owned < chosen_.owned_count ? owned : place_[vertex];
  }

 private:
  ClusterFacets chosen_{};
  std::vector<int> place_;  // of each vertex of the mesh among the borrowed ones
};

}  // namespace tact::narrowphase

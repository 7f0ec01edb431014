// All pairs of features nearer than a reach, of two meshes, or of one with itself, among those of open clusters.
#pragma once

#include <tact/reach_pair.h>

#include <vector>

#include "narrowphase/contact_points/near_features.h"

namespace tact::narrowphase {

class ReachFinder {
 public:
  /// Pairs are appended to `found`; `reach` is scaled.
  ReachFinder(const ScaledMesh& a, const ScaledMesh& b, double reach, std::vector<ReachPair>& found)
      : a_(a), b_(b), same_(&a.mesh == &b.mesh), reach_(reach), found_(found) {}

  /// Of two open clusters. The boxes of `a` are wider by the reach.
  void search(const OpenFeatures& a, const OpenFeatures& b);

 private:
  void from_vertices(const OpenFeatures& one, const OpenFeatures& other, const NearFacets& near, FeaturePair kind);
  void add_vertex(FeaturePair kind, int vertex, Vec3 v, int facet);
  void add_edges(int edge_a, int edge_b);

  const ScaledMesh a_, b_;
  const bool same_;
  const double reach_;
  std::vector<ReachPair>& found_;
};

}  // namespace tact::narrowphase

// Which pairs of clusters of one mesh are worth looking into.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/pairs/cluster_pairs.h"
#include "narrowphase/self/smooth_patches.h"

namespace tact::narrowphase {

/// A mesh, what lies around its features, and around its clusters.
struct SelfMesh {
  FeaturedMesh featured;
  const ClusterNeighbors* neighbors = nullptr;
};

/// The pairs of clusters of a mesh that are near each other, but for those of which smooth_patches.h proves that there
/// is nothing to find. The smaller cluster comes first; each cluster with itself is a pair, too. Memory is used again.
class SelfClusters {
 public:
  /// `reach` in metres; zero: no contact points are wanted. Errors: those of ClusterPairFinder::find().
  void find(const SelfMesh& self, double reach, const base::Tuning& tuning, int threads, EmbreeDevice& device);

  /// Those whose boxes overlap and whose facets may meet. Sorted, as those below.
  std::span<const ClusterPair> may_meet() const { return may_meet_; }
  /// Those whose boxes come within `reach` and that may have contact points; none if it is zero.
  std::span<const ClusterPair> may_contact() const { return may_contact_; }

 private:
  void judge_centers(const SelfMesh& self, int threads);
  void judge_corners(const SelfMesh& self, int threads);
  bool never_meet_at_corner(const ClusterNeighbors& neighbors, const ClusterPair& pair) const;
  SelfVerdict from_centers(const ClusterNeighbors& neighbors, const ClusterPair& pair) const;
  void judge(const SelfMesh& self, std::span<const ClusterPair> near, SelfVerdict wanted, int threads);

  ClusterPairFinder finder_;
  SmoothPatches patches_;
  std::vector<SmoothPatches::Judge> judges_;  // a thread each
  std::vector<SelfVerdict> verdicts_;         // of the near pairs
  std::vector<SelfVerdict> of_center_;        // of all clusters around a center; of each cluster
  std::vector<SelfVerdict> best_around_;      // of each cluster: the best of the centers around it
  std::vector<char> never_meet_at_;           // of all clusters at a corner
  std::vector<ClusterPair> may_meet_, may_contact_;
};

}  // namespace tact::narrowphase

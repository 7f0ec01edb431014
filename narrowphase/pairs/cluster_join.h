// Which boxes of two lists of clusters overlap, where neighbours in a list are neighbours in space: by a loop where
// they are few; of more, runs of boxes first, by a loop or by Embree's trees.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/tuning.h"
#include "narrowphase/pairs/cluster_forest.h"
#include "narrowphase/pairs/cluster_pair.h"
#include "narrowphase/pairs/kept_clusters.h"

namespace tact::narrowphase {

/// Of two lists all pairs (i, j), or those with i <= j: of one list with itself each pair once.
enum class BoxPairs { all, ascending };

/// The pairs (i, j) of boxes a.boxes[i] and b.boxes[j] that overlap, sorted; of them those that are wanted. Its memory
/// is used again.
class ClusterJoin {
 public:
  /// Replaces `pairs` by all of them. Errors: those of ClusterForest::build().
  void run(const KeptClusters& a, const KeptClusters& b, BoxPairs wanted, const base::Tuning& tuning,
           EmbreeDevice& device, std::vector<ClusterPair>& pairs);
  /// Whether trees were used.
  bool uses_trees() const { return way_ == Way::trees; }

  /// The same pairs with A and B exchanged, sorted again. There are `clusters` clusters of B.
  void exchange_meshes(std::vector<ClusterPair>& pairs, int clusters);

 private:
  enum class Way { each, runs, trees };

  void find_in_each(std::vector<ClusterPair>& pairs);
  void make_runs(EmbreeDevice& device);
  void find_in_run(int run, std::vector<ClusterPair>& pairs);
  void find_near_runs(const BoxBounds& run, int first);
  void find_near(const BoxBounds& run);

  const KeptClusters* a_ = nullptr;
  const KeptClusters* b_ = nullptr;
  BoxPairs wanted_ = BoxPairs::all;
  Way way_ = Way::each;
  BoxArrays run_boxes_;                  // of B
  ClusterForest forest_;                 // over these
  std::vector<std::int32_t> near_runs_;  // of B, near a run of A
  BoxArrays near_;                       // boxes of B near a run of A
  std::vector<std::int32_t> place_;      // of these in B
  std::vector<std::int32_t> found_, stack_;
  std::vector<ClusterPair> exchanged_;
};

}  // namespace tact::narrowphase

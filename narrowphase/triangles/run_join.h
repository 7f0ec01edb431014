// Which boxes of two lists overlap, where neighbours in a list are neighbours in space, as kept clusters are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/triangles/cluster_forest.h"
#include "narrowphase/triangles/confirm_input.h"

namespace tact::narrowphase {

/// Of two lists all pairs (i, j), or those with i <= j: of one list with itself each pair once.
enum class BoxPairs { all, ascending };

/// Boxes are looked at in runs of 32: each run of A is held against the runs of B, by a loop or by Embree's trees, and
/// its boxes against those boxes of B that are near the run. Its memory is used again.
class RunJoin {
 public:
  enum class Runs { loop, forest };

  /// Appends the pairs (i, j) of boxes a[i] and b[j] that overlap, sorted; of them those that are wanted. Errors: those
  /// of ClusterForest::build().
  void run(const BoxArrays& a, int count_a, const BoxArrays& b, int count_b, Runs runs, BoxPairs wanted,
           EmbreeDevice& device, std::vector<ClusterPair>& pairs);

 private:
  void find_near_runs(const BoxBounds& run, int first, Runs runs);
  void find_near(const BoxArrays& b, int count_b, const BoxBounds& run);

  BoxArrays run_boxes_;  // of B
  std::size_t run_count_ = 0;
  ClusterForest forest_;                 // over these
  std::vector<std::int32_t> near_runs_;  // of B, near a run of A
  BoxArrays near_;                       // boxes of B near a run of A
  std::vector<std::int32_t> place_;      // of these in B
  std::vector<std::int32_t> found_;
};

}  // namespace tact::narrowphase

// What is known of the cluster pairs of two surfaces from step to step: how far apart they are, at least.
//
// Clusters that were apart by some distance still are if their vertices have gone less far since, both together. So a
// certificate is a number: the pair is apart as long as the travel of both, see MeshTravel, is less. All of it is
// rounded so that it errs towards looking again. And whether to look at them as surfaces saves more than it costs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/triangles/block_pair.h"
#include "narrowphase/triangles/confirm_input.h"

namespace tact::narrowphase {

/// Steps in which something that did not pay is not tried: twice as many after each failure.
class Pause {
 public:
  bool lasts() const { return left_ > 0; }
  /// Returns whether this step is one of them.
  bool takes_step() { return left_ > 0 && left_-- > 0; }
  /// After a step in which it was tried.
  void judge(bool pays);

 private:
  static constexpr int kFirst = 16, kLongest = 256;

  int left_ = 0, next_ = kFirst;
};

class SurfaceHistory {
 public:
  /// False in a pause: what a step as surfaces saved, by counts, was too little. Once a step.
  bool takes_as_surfaces() { return !surfaces_.takes_step(); }
  /// After a step as surfaces.
  void weigh(const ConfirmCounts& counts);

  /// Cluster `a` of A and `b` of B.
  struct Certificate {
    std::int32_t a = 0;
    std::int32_t b = 0;
    double until = 0.0;  ///< metres; 0: nothing is known
  };

  /// Before the cluster pairs of a step are looked at. Returns whether certificates can be of use: each body stands or
  /// keeps its travel, and moves little. Those of the last step are at hand then as far as the meshes are the same.
  /// Never in a pause, which begins when certificates saved too little.
  bool start(const ConfirmInput& input, const std::vector<ClusterPair>& pairs);
  /// After a step that start() let use certificates: how many of its pairs these told to be apart.
  void finish(std::int64_t still_apart);

  bool pauses() const { return certificates_.lasts(); }

  /// After start(): it would help if A kept its travel, or B.
  bool wants_travel_of_a() const { return of_a_.wants_travel; }
  bool wants_travel_of_b() const { return of_b_.wants_travel; }

  /// Those of the last step, sorted; and one for each pair of this step, to be written.
  std::span<const Certificate> last() const { return last_; }
  std::span<Certificate> now() { return now_; }

 private:
  struct OfBody {
    const ClusteredMesh* mesh = nullptr;
    std::uint64_t epoch = 0;
    bool wants_travel = false;

    // Sets `same` to false if the mesh is another one, or has moved without its travel being kept.
    bool start(const ClusteredMesh& now, bool& same);
  };

  std::vector<Certificate> last_, now_;
  OfBody of_a_, of_b_;
  Pause certificates_, surfaces_;
};

/// The travel of two clusters, rounded up.
inline double travel_of(const ClusteredMesh& a, int cluster_a, const ClusteredMesh& b, int cluster_b) {
  constexpr double kUp = 1.0 + 0x1p-50;
  return ((a.travel() == nullptr ? 0.0 : a.travel()->of(cluster_a)) +
          (b.travel() == nullptr ? 0.0 : b.travel()->of(cluster_b))) *
         kUp;
}
/// Until when two clusters of this travel, which are apart by `gap` metres at least, are apart.
inline double apart_until(double travel, double gap) {
  constexpr double kDown = 1.0 - 0x1p-48;
  return (travel + gap) * kDown;
}

}  // namespace tact::narrowphase

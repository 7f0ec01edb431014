// What meets between the last step and now: boxes of whole ways, swept as those of a step are; then clusters, then
// features.
#pragma once

#include <tact/motion.h>
#include <tact/settings.h>

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/sweep_and_prune.h"
#include "engine/bodies/bodies.h"
#include "engine/bodies/plane_pairs.h"
#include "engine/pair/plane_pair.h"
#include "engine/shared_work.h"
#include "narrowphase/motion/impacts.h"

namespace tact {

class MotionStage {
 public:
  const MotionReport& run(Bodies& bodies, const Settings& settings, Impacts wanted);

 private:
  /// Two bodies, or one twice, of which one moves.
  struct Passing {
    std::uint32_t a = 0, b = 0;
    double reach = 0.0;
    // Where their cluster pairs are: those of a thread.
    std::size_t thread = 0, begin = 0, end = 0;
  };
  /// What was found in a range of cluster pairs.
  struct Found {
    double earliest = 0.0;  // no impact in it is earlier
    std::vector<narrowphase::FeatureImpact> impacts;
  };
  using Work = SharedWork<std::size_t, Found>;  // of the place among those that pass
  /// A cluster pair and the time before which nothing meets in it.
  struct TimedPair {
    double earliest;
    narrowphase::ClusterPair pair;
  };
  /// Memory of a thread, used again.
  struct Memory {
    narrowphase::ClusterPairFinder passing;
    std::vector<narrowphase::ClusterPair> clusters;
    std::vector<TimedPair> timed;  // scratch
    std::int64_t cluster_pairs = 0;
    narrowphase::ImpactFinder finder;
    narrowphase::MotionCounts counts;
  };

  void sweep(const Bodies& bodies, int threads);
  void select(Bodies& bodies, int threads);
  void place(Bodies& bodies, int threads);
  base::Box way_box(const Bodies& bodies, std::uint32_t slot) const;
  void make_features(Bodies& bodies, int threads);
  void find_clusters(const Bodies& bodies, int threads, Impacts wanted);
  static void sort_by_time(const Passing& passing, const Bodies& bodies, std::size_t begin, Memory& memory);
  std::span<const narrowphase::ClusterPair> clusters_of(const Passing& passing) const;
  void cut_into_ranges(const Bodies& bodies, Impacts wanted);
  void search(const Bodies& bodies, int threads, Impacts wanted);
  void make_report(const Bodies& bodies, Impacts wanted);
  void gather(const Work::Shared& shared, const Bodies& bodies);

  static void find_clusters_near_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body, double reach,
                                       std::vector<narrowphase::ClusterPair>& clusters);
  static void search_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body, double reach,
                           std::span<const narrowphase::ClusterPair> clusters, std::atomic<double>* first,
                           Found& found);

  broadphase::SweepAndPrune sweep_;
  PlanePairs planes_;
  std::vector<base::Box> boxes_;             // of the ways, a slot each
  std::vector<broadphase::Filter> filters_;  // with which they were swept
  std::vector<std::uint32_t> changed_;
  std::vector<Passing> passing_;
  std::vector<std::uint32_t> slots_;  // scratch
  Work work_;
  std::vector<Memory> memory_;              // of each thread
  std::vector<std::atomic<double>> first_;  // of each pair that passes, or of all
  std::vector<narrowphase::FeatureImpact> gathered_;
  narrowphase::EmbreeDevice device_;
  MotionReport report_;
};

}  // namespace tact

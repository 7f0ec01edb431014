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
#include "engine/base/moving_box.h"
#include "engine/bodies/bodies.h"
#include "engine/bodies/plane_pairs.h"
#include "engine/known_ways.h"
#include "engine/motion_bounds.h"
#include "engine/pair/plane_pair.h"
#include "engine/shared_work.h"
#include "narrowphase/motion/impacts.h"

namespace tact {

/// Errors: invalid_argument.
void check_motion_options(const MotionOptions& options);

class MotionStage {
 public:
  const MotionReport& run(Bodies& bodies, const Settings& settings, const MotionOptions& options);

  /// Before anything changes of the bodies but positions and poses. No answer depends on what is not forgotten.
  void forget_ways() { known_.forget(); }

 private:
  /// Two bodies, or one twice, of which one moves.
  struct Passing {
    std::uint32_t a = 0, b = 0;
    double reach = 0.0;
    bool has_planes = false;  // planes left out some of its cluster pairs
    bool is_known = false;    // then its candidates are, and cluster pairs stand for kCandidates of them each
    KnownWays::Candidates known = {};
    // Where their cluster pairs are: those of a thread.
    std::size_t thread = 0, begin = 0, end = 0;
  };
  /// What was found in a range of cluster pairs.
  struct Found {
    double earliest = 0.0;  // no impact in it is earlier
    std::vector<narrowphase::FeatureImpact> impacts;
    std::vector<narrowphase::FeatureCandidate> kept;
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

  /// What all parts of a call are given.
  struct Call {
    Bodies& bodies;
    int threads;
    const MotionOptions& options;
    bool only_changed = false;  // what bounds_ changed, with all

    bool wants_all() const { return options.wanted == Impacts::all; }
    /// By how much a box that holds so much of a distance is too small for half of the one that is asked for.
    double wider(double held) const;
    /// How near two bodies, or one twice, come to meet, and which of their features.
    narrowphase::FeatureRules rules(std::uint32_t a, std::uint32_t b) const;
  };

  void note_call(const Bodies& bodies);
  void find(const Call& call);
  void sweep(const Call& call);
  void find_ways(const Call& call);
  base::Vec3 frame_of_ways(const Bodies& bodies) const;
  void select(const Call& call);
  void place(const Call& call);
  void leave_out_apart(const Call& call);
  base::MovingBox way_box(const Call& call, std::uint32_t slot) const;
  narrowphase::MovingMesh moving(const Bodies& bodies, std::uint32_t slot) const {
    return bounds_.moving(bodies, slot);
  }
  void make_features(const Call& call);
  void begin_search(const Call& call);
  void find_known(const Call& call);
  void keep_ways(const Call& call);
  void find_clusters(const Call& call);
  void leave_out_clusters(Passing& passing, const Call& call, std::size_t begin, Memory& memory) const;
  std::span<const narrowphase::ClusterPair> clusters_of(const Passing& passing) const;
  void cut_into_ranges(const Call& call);
  void search(const Call& call);
  void search_range(const Passing& passing, const Call& call, std::atomic<double>* first, Work::Range& range,
                    Memory& memory) const;
  void make_report(const Call& call);
  void count_found();
  void gather(const Work::Shared& shared, const Bodies& bodies);
  void find_bounds(Call call);
  bool lower_bounds(const Bodies& bodies);

  void sweep_planes(const Call& call);
  bool stays_apart(const Call& call, const BodyAndPlane& pair, const Passing& one) const;
  static void find_clusters_near_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body, double reach,
                                       std::vector<narrowphase::ClusterPair>& clusters);
  static void search_plane(const BodyAndPlane& pair, const narrowphase::MovingMesh& body,
                           const narrowphase::FeatureRules& rules, std::span<const narrowphase::ClusterPair> clusters,
                           std::atomic<double>* first, Found& found);

  broadphase::SweepAndPrune sweep_;
  PlanePairs planes_;
  std::vector<base::MovingBox> ways_;  // a slot each
  std::vector<base::Box> boxes_;       // of the ways, a slot each, seen from what goes frame_
  std::vector<base::Box> whole_ways_;  // of the ways, for planes
  base::Vec3 frame_{};
  std::vector<broadphase::Filter> filters_;  // with which they were swept
  std::vector<std::uint32_t> changed_;
  std::vector<Passing> passing_;
  std::vector<std::uint32_t> slots_;  // scratch
  Work work_;
  std::vector<Memory> memory_;              // of each thread
  std::vector<std::atomic<double>> first_;  // of each pair that passes, or of all
  std::vector<narrowphase::FeatureImpact> gathered_;
  MotionBounds bounds_;
  KnownWays known_;
  bool keeps_ways_ = false;   // of this call
  bool expects_more_ = true;  // calls before the next step: in the last one with any there were
  std::uint64_t step_ = 0;    // after which calls_ were
  std::int64_t calls_ = 0;
  double largest_ = 0.0;  // coordinate of those that pass, on their ways
  narrowphase::EmbreeDevice device_;
  MotionReport report_;
};

}  // namespace tact

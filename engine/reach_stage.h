// All pairs of features within reach: of the pairs that a step looked at, and of bodies with themselves.
#pragma once

#include <tact/reach_pair.h>
#include <tact/settings.h>

#include <memory>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/feature_order.h"
#include "engine/pair/pair_table.h"
#include "engine/self_record.h"
#include "engine/shared_work.h"
#include "narrowphase/contact_points/contact_points.h"

namespace tact {

class ReachStage {
 public:
  /// Finds them of every pair of `moved` that is in contact, and of every body of `selves`, where margins are above
  /// zero; each into its record.
  void find(std::span<const MovedPair> moved, std::span<SelfRecord* const> selves, Bodies& bodies,
            const Settings& settings, narrowphase::EmbreeDevice& device);

 private:
  /// Two bodies, or one twice.
  struct Wanted {
    std::uint32_t a = 0, b = 0;
    double reach = 0.0;
    std::vector<ReachPair>* pairs = nullptr;
  };
  /// What of one of those is near.
  struct Prepared {
    const Wanted* wanted = nullptr;
    narrowphase::ClusterPairFinder near;
    std::span<const narrowphase::ClusterPair> cluster_pairs;
  };
  /// Memory of a thread, used again.
  struct Work {
    std::unique_ptr<Prepared> prepared;
    narrowphase::ContactPointSearch search;
    std::vector<ReachPair> found;
    FeatureOrder order;
  };
  using Large = SharedWork<std::unique_ptr<Prepared>, std::vector<ReachPair>>;

  void list(std::span<const MovedPair> moved, std::span<SelfRecord* const> selves, const Bodies& bodies);
  void find_one(std::size_t i, const Bodies& bodies, const Settings& settings, narrowphase::EmbreeDevice& device,
                Work& work);

  std::vector<Wanted> wanted_;
  std::vector<std::uint32_t> slots_;  // scratch
  std::vector<Work> work_;            // a thread each
  Large large_;
};

}  // namespace tact

// Contact points of the pairs that a step looked at, and of bodies with themselves.
#pragma once

#include <tact/contact_point.h>
#include <tact/settings.h>

#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_table.h"
#include "engine/patches.h"
#include "narrowphase/contact_points/contact_points.h"
#include "narrowphase/crossing/crossing_points.h"
#include "narrowphase/crossing/pair_crossing.h"
#include "narrowphase/crossing/self_crossing.h"

namespace tact {

class PointStage {
 public:
  /// Finds the points of every pair of `moved` that is in contact and has a margin, or facets that meet, or of which
  /// one body is inside the other; each into its record.
  void run(std::span<const MovedPair> moved, Bodies& bodies, const Settings& settings,
           narrowphase::EmbreeDevice& device);
  /// A body with itself.
  struct Self {
    std::uint32_t slot = 0;
    std::span<const narrowphase::ClusterPair> cluster_pairs;
    std::span<const FacetPair> facet_pairs;
    std::span<const ContactPoint> last_points;
    narrowphase::SelfCrossing* crossing = nullptr;  // if facets meet
  };
  /// Its points into `points`, on all threads.
  void run_self(const Self& self, Bodies& bodies, const Settings& settings, std::vector<ContactPoint>& points);

 private:
  /// What a point is sorted by first, and where it is.
  struct PointOrder {
    std::uint64_t kind_and_first, others;
    std::uint32_t place;
  };
  /// Memory of a thread, used again.
  struct Work {
    narrowphase::NearClusters near[2];  // of pairs with even numbers, and with odd ones
    std::size_t ahead = 0;              // the pair that `near` knows already, and one more; 0: none
    std::span<const narrowphase::ClusterPair> ahead_pairs;
    narrowphase::ContactPointSearch search;
    narrowphase::PairCrossing crossing;
    narrowphase::CrossingPoints crossing_points;
    std::vector<narrowphase::CarriedNormal> carried_a, carried_b;
    std::vector<narrowphase::FeaturePoint> found, last;
    std::vector<PointOrder> order;
    PatchFinder patches;
  };
  /// Two bodies, or one twice.
  struct Wanted {
    std::uint32_t a = 0, b = 0;
    double reach = 0.0;
    std::vector<ContactPoint>* points = nullptr;
    const PairRecord* record = nullptr;  // of two bodies
    const Self* self = nullptr;          // of one
  };
  void select(std::span<const MovedPair> moved, const Bodies& bodies);
  void make_features(Bodies& bodies, int threads);
  std::span<const narrowphase::ClusterPair> near_clusters(std::size_t i, const Bodies& bodies, Work& work,
                                                          narrowphase::EmbreeDevice& device) const;
  void look_ahead(std::size_t i, const Bodies& bodies, Work& work, narrowphase::EmbreeDevice& device) const;
  void publish(const Wanted& wanted, const Bodies& bodies, Work& work) const;
  static narrowphase::NearRules find_crossing(const Wanted& wanted, const Bodies& bodies, Work& work);
  static const narrowphase::Crossing* find_self_crossing(const Wanted& wanted, const Bodies& bodies, Work& work);
  void search_in_ranges(const Wanted& wanted, const Bodies& bodies, std::span<const narrowphase::ClusterPair> pairs,
                        int threads);

  std::vector<Wanted> wanted_;
  std::vector<std::uint32_t> slots_;  // scratch
  std::vector<Work> work_;            // a thread each
  bool numbers_patches_ = true;
  std::vector<char> is_large_;  // of the wanted ones
  std::vector<std::vector<narrowphase::FeaturePoint>> ranges_;
};

}  // namespace tact

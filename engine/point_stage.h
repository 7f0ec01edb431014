// Contact points of the pairs that a step looked at, and of bodies with themselves.
#pragma once

#include <tact/contact_point.h>
#include <tact/settings.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/feature_order.h"
#include "engine/pair/pair_table.h"
#include "engine/pair/plane_pair.h"
#include "engine/patches.h"
#include "engine/self_record.h"
#include "engine/shared_work.h"
#include "narrowphase/contact_points/contact_points.h"
#include "narrowphase/crossing/crossing_points.h"
#include "narrowphase/crossing/pair_crossing.h"

namespace tact {

class PointStage {
 public:
  /// Finds the points of every pair of `moved` that is in contact and has a margin, or facets that meet, or of which
  /// one body is inside the other; each into its record.
  void find(std::span<const MovedPair> moved, Bodies& bodies, const Settings& settings,
            narrowphase::EmbreeDevice& device);
  /// The same of bodies with themselves, of which the facet pairs and the cluster pairs that may have points are known.
  void find(std::span<SelfRecord* const> selves, Bodies& bodies, const Settings& settings,
            narrowphase::EmbreeDevice& device);

 private:
  /// Two bodies, or one twice.
  struct Wanted {
    std::uint32_t a = 0, b = 0;
    double reach = 0.0;
    std::vector<ContactPoint>* points = nullptr;
    const PairRecord* record = nullptr;  // of two bodies
    SelfRecord* self = nullptr;          // of one
    BodyAndPlane plane = {};             // of a body and a plane
  };
  /// What is known of one of those before its points are searched.
  struct Prepared {
    const Wanted* wanted = nullptr;
    narrowphase::ClusterPairFinder near;
    std::span<const narrowphase::ClusterPair> cluster_pairs;
    narrowphase::PairCrossing crossing;
    std::vector<narrowphase::CarriedNormal> carried_a, carried_b;
    std::vector<narrowphase::FeaturePoint> last;  // points of the last step: of one body, or between edges of two
    std::vector<FacetPair> meeting;               // memory: pairs of facets, edges and points
    std::vector<std::int32_t> near_plane;         // vertices
    std::vector<narrowphase::ClusterPair>
        vertex_blocks;  // of these: numbers of the first and of the one behind the last
    narrowphase::NearRules rules;
  };
  /// Memory of a thread, used again.
  struct Work {
    std::array<std::unique_ptr<Prepared>, 2> prepared;  // of items with even numbers, and with odd ones
    std::size_t ahead = 0;                              // the item that is prepared already, and one more; 0: none
    narrowphase::ContactPointSearch search;
    narrowphase::CrossingPoints crossing_points;
    std::vector<narrowphase::FeaturePoint> found;
    FeatureOrder order;
    PatchFinder patches;
  };
  using Large = SharedWork<std::unique_ptr<Prepared>, std::vector<narrowphase::FeaturePoint>>;
  /// What all items of a step have in common.
  struct Step {
    const Bodies& bodies;
    const Settings& settings;
    narrowphase::EmbreeDevice& device;
    std::size_t grain;  // items that a thread takes at a time: it prefetches the next one while it searches one
    bool prefetches;
  };

  void find_wanted(Bodies& bodies, const Settings& settings, narrowphase::EmbreeDevice& device);
  Prepared& find_near(std::size_t i, const Step& step, Work& work) const;
  void look_ahead(std::size_t i, const Step& step, Work& work) const;
  static void find_near_plane(Prepared& prepared);
  static void search_plane(const Prepared& prepared, std::span<const narrowphase::ClusterPair> blocks,
                           std::vector<narrowphase::FeaturePoint>& found);
  void find_points(std::size_t i, const Step& step, Work& work);
  static void search(const Prepared& prepared, std::span<const narrowphase::ClusterPair> pairs, const Step& step,
                     narrowphase::ContactPointSearch::Given given, std::vector<narrowphase::FeaturePoint>& found,
                     Work& work);
  static narrowphase::NearRules find_crossing(const Bodies& bodies, Prepared& prepared);
  static const narrowphase::Crossing* find_self_crossing(const Bodies& bodies, Prepared& prepared);
  static void finish(const Prepared& prepared, const Step& step, int threads, Work& work);
  static void publish(const Wanted& wanted, const Step& step, int threads, Work& work);

  std::vector<Wanted> wanted_;
  std::vector<std::uint32_t> slots_;  // scratch
  std::vector<Work> work_;            // a thread each
  Large large_;
};

}  // namespace tact

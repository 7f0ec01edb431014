// What the stages of a pair get, and hand to each other.
#pragma once

#include <tact/settings.h>

#include <vector>

#include "engine/base/key_sort.h"
#include "engine/bodies/bodies.h"
#include "engine/pair/pair_counts.h"
#include "engine/pair/pair_record.h"
#include "narrowphase/depth/smallest_separation.h"
#include "narrowphase/direction/minkowski_face.h"
#include "narrowphase/hull/minkowski_difference.h"
#include "narrowphase/pairs/cluster_join.h"
#include "narrowphase/pairs/cluster_separation.h"
#include "narrowphase/triangles/confirm.h"

namespace tact {

/// What stage 5 leaves of a pair for stage 6.
struct CulledPair {
  PairRecord* record = nullptr;
  const narrowphase::ClusteredMesh* a = nullptr;
  const narrowphase::ClusteredMesh* b = nullptr;
  narrowphase::Criteria criteria_a, criteria_b;
  narrowphase::KeptClusters kept_a, kept_b;
  std::vector<narrowphase::ClusterPair> cluster_pairs;
  bool as_surfaces = false;  ///< see surface_pairs.h
  bool swapped = false;      ///< for stage 6 the second body is A, and the first is B: so in cluster_pairs
  narrowphase::SurfaceHistory* history = nullptr;  ///< of the record, if it is of use in this step
  TraceEvent::Time end;                            ///< of a large pair: when its facet pairs stood in the record

  narrowphase::ConfirmInput confirm_input(const base::Tuning& tuning) const {
    if (swapped) return {b, a, criteria_b, criteria_a, &kept_b, &kept_a, as_surfaces, history, &tuning};
    return {a, b, criteria_a, criteria_b, &kept_a, &kept_b, as_surfaces, history, &tuning};
  }
};

/// A thread's memory for the stages, used again from pair to pair, and its counts of all pairs in a step.
struct PairWork {
  PairCounts counts;
  std::vector<BodyId> keep_travel;   ///< bodies that lie on others: the travel of their clusters is kept from now on
  std::vector<std::int32_t> chosen;  ///< scratch: vertices
  narrowphase::FaceFinder faces;
  narrowphase::SmallestMemory smallest;
  std::vector<narrowphase::Point2> zone_points;
  narrowphase::ClusterJoin join;
  narrowphase::ClusterSeparation separation;
  bool prefetches = true;  ///< the memory of facets, see Bodies::stay_in_cache()
  CulledPair culled;
  narrowphase::FacetPairSearch search;
  base::KeySorter sorter;
  std::vector<char> seen_b;  ///< scratch: by kept cluster of B, of a large pair
};

/// What a stage of a pair gets: the two bodies, what the pair keeps, and the memory of the thread.
struct PairTask {
  PairTask(const Bodies& bodies, PairRecord& of_pair, const Settings& of_world, PairWork& of_thread)
      : a(bodies.in_slot(of_pair.a.index)),
        b(bodies.in_slot(of_pair.b.index)),
        difference(a.mesh, b.mesh, bodies.tuning()),
        reach(bodies.reach(of_pair.a.index, of_pair.b.index)),
        settings(of_world),
        tuning(bodies.tuning()),
        record(of_pair),
        work(of_thread) {}

  const Body& a;
  const Body& b;
  narrowphase::MinkowskiDifference difference;  ///< of their hulls
  double reach;                                 ///< the sum of their margins, metres: hulls nearer than this are near
  const Settings& settings;
  const base::Tuning& tuning;
  PairRecord& record;
  PairWork& work;
};

}  // namespace tact

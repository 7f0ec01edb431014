// What the stages of a pair hand to each other: the two bodies, what the criteria leave of them, a thread's memory.
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
#include "narrowphase/triangles/confirm.h"

namespace tact {

/// Two bodies as the stages of a pair see them.
struct PairInput {
  PairInput(const Bodies& bodies, BodyId id_a, BodyId id_b, const Settings& of_world)
      : a(bodies.in_slot(id_a.index)),
        b(bodies.in_slot(id_b.index)),
        difference(a.mesh, b.mesh, bodies.tuning()),
        reach(bodies.reach(id_a.index, id_b.index)),
        settings(of_world),
        tuning(bodies.tuning()) {}

  const Body& a;
  const Body& b;
  narrowphase::MinkowskiDifference difference;  ///< of their hulls
  double reach;                                 ///< the sum of their margins, metres: hulls nearer than this are near
  const Settings& settings;
  const base::Tuning& tuning;
};

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

  narrowphase::ConfirmInput confirm_input(const base::Tuning& tuning) const {
    if (swapped) return {b, a, criteria_b, criteria_a, &kept_b, &kept_a, as_surfaces, history, &tuning};
    return {a, b, criteria_a, criteria_b, &kept_a, &kept_b, as_surfaces, history, &tuning};
  }
};

/// A thread's memory for the stages, used again from pair to pair, and its counts of all pairs in a step.
struct PairWork {
  PairCounts counts;
  std::vector<BodyId> keep_travel;  ///< bodies that lie on others and would do well to keep how far they go
  narrowphase::FaceFinder faces;
  narrowphase::SmallestMemory smallest;
  std::vector<narrowphase::Point2> zone_points;
  narrowphase::ClusterPairWork cluster_pair_work;
  bool prefetches = true;  ///< the memory of facets, see Bodies::stay_in_cache()
  CulledPair culled;
  narrowphase::FacetPairSearch search;
  base::KeySorter sorter;
};

}  // namespace tact

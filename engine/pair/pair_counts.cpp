#include "engine/pair/pair_counts.h"

namespace tact {

PairCounts& PairCounts::operator+=(const PairCounts& other) {
  still_separated += other.still_separated;
  still_overlapping += other.still_overlapping;
  separated += other.separated;
  limits_reached += other.limits_reached;
  gjk_iterations += other.gjk_iterations;
  direction_iterations += other.direction_iterations;
  carried_directions += other.carried_directions;
  fresh_directions += other.fresh_directions;
  smallest_directions += other.smallest_directions;
  clusters += other.clusters;
  clusters_outside_box += other.clusters_outside_box;
  clusters_outside_slab += other.clusters_outside_slab;
  facets += other.facets;
  cluster_pairs += other.cluster_pairs;
  tree_pairs += other.tree_pairs;
  cull += other.cull;
  confirm += other.confirm;
  hulls_ms += other.hulls_ms;
  gjk_ms += other.gjk_ms;
  direction_ms += other.direction_ms;
  cull_ms += other.cull_ms;
  confirm_ms += other.confirm_ms;
  return *this;
}

}  // namespace tact

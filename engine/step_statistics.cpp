#include "engine/step_statistics.h"

#include <algorithm>

namespace tact {

void count_bodies(const Bodies& bodies, StepStats& stats) {
  stats.bodies = static_cast<std::int64_t>(bodies.count());
  stats.vertices = bodies.vertices();
  stats.moved_bodies = std::ranges::count_if(bodies.changed(), [&](std::uint32_t slot) { return bodies.used(slot); });
  stats.moved_vertices = bodies.moved_vertices();
  stats.placed_bodies = bodies.placed_count();
}

void count_pairs(const PairTable& table, StepStats& stats) {
  stats.candidate_pairs = static_cast<std::int64_t>(table.candidates().size());
  stats.kdop_separated_pairs = static_cast<std::int64_t>(table.separated());
  stats.kept_pairs =
      stats.candidate_pairs - stats.kdop_separated_pairs - static_cast<std::int64_t>(table.moved().size());
}

void count_work(const PairStage& narrow_phase, StepStats& stats) {
  const PairCounts counts = narrow_phase.counts();
  stats.still_separated_pairs = counts.still_separated;
  stats.still_overlapping_pairs = counts.still_overlapping;
  stats.separated_pairs = counts.separated;
  stats.carried_directions = counts.carried_directions;
  stats.fresh_directions = counts.fresh_directions;
  stats.smallest_directions = counts.smallest_directions;
  stats.direction_iterations = counts.direction_iterations;
  stats.gjk_iterations = counts.gjk_iterations;
  stats.limits_reached = counts.limits_reached;
  stats.clusters = counts.clusters;
  stats.clusters_outside_box = counts.clusters_outside_box;
  stats.clusters_outside_slab = counts.clusters_outside_slab;
  stats.opened_clusters = counts.cull.opened_clusters;
  stats.opened_facets = counts.cull.facets();
  stats.facets = counts.facets;
  stats.facets_facing_away = counts.cull.facing_away;
  stats.facets_outside_slab = counts.cull.outside_slab;
  stats.facets_outside_box = counts.cull.outside_box;
  stats.facets_outside_zone = counts.cull.outside_zone;
  stats.kept_facets = counts.cull.kept;
  stats.cluster_pairs = counts.cluster_pairs;
  stats.tree_pairs = counts.tree_pairs;
  stats.facet_box_pairs = counts.confirm.facet_box_pairs;
  stats.triangle_tests = counts.confirm.triangle_tests;
  stats.exact_predicates = counts.confirm.predicates.exact;
  stats.kdop_ms = narrow_phase.kdop_ms();
  stats.hulls_ms = narrow_phase.kdop_ms() + counts.hulls_ms;
  stats.gjk_ms = counts.gjk_ms;
  stats.direction_ms = counts.direction_ms;
  stats.cull_ms = counts.cull_ms;
  stats.confirm_ms = counts.confirm_ms;
}

}  // namespace tact

#include "engine/step_statistics.h"

namespace tact {

void add_work(const PairRecord& record, const Settings& settings, StepStats& stats) {
  const PairCounts& counts = record.counts;
  stats.gjk_iterations += counts.gjk_iterations;
  stats.hulls_ms += counts.hulls_ms;
  stats.gjk_ms += counts.still_separated || counts.still_overlapping ? 0.0 : counts.hulls_ms;
  stats.still_overlapping_pairs += counts.still_overlapping ? 1 : 0;
  stats.direction_ms += counts.direction_ms;
  stats.cull_ms += counts.cull_ms;
  stats.confirm_ms += counts.confirm_ms;
  if (!record.hulls_overlap) {
    stats.limits_reached += counts.limit_reached ? 1 : 0;
    (counts.still_separated ? stats.still_separated_pairs : stats.separated_pairs) += 1;
    return;
  }
  const Contact& contact = record.contact;
  stats.limits_reached += contact.limit_reached ? 1 : 0;
  stats.direction_iterations += contact.iterations;
  stats.carried_directions += contact.source == DirectionSource::carried ? 1 : 0;
  stats.fresh_directions += contact.source == DirectionSource::fresh ? 1 : 0;
  stats.smallest_directions += contact.source == DirectionSource::smallest ? 1 : 0;
  if (settings.accuracy == Accuracy::hulls) return;
  const FacetCounts& facet_counts = record.facet_counts;
  stats.clusters += facet_counts.clusters;
  stats.clusters_outside_box += facet_counts.clusters_outside_box;
  stats.clusters_outside_slab += facet_counts.clusters_outside_slab;
  stats.opened_clusters += facet_counts.cull.opened_clusters;
  stats.opened_facets += facet_counts.cull.facets();
  stats.facets += facet_counts.facets;
  stats.kept_facets += facet_counts.cull.kept;
  stats.facets_facing_away += facet_counts.cull.facing_away;
  stats.facets_outside_slab += facet_counts.cull.outside_slab;
  stats.facets_outside_box += facet_counts.cull.outside_box;
  stats.facets_outside_zone += facet_counts.cull.outside_zone;
  stats.cluster_pairs += facet_counts.cluster_pairs;
  stats.tree_pairs += facet_counts.used_trees ? 1 : 0;
  stats.facet_box_pairs += facet_counts.facet_box_pairs;
  stats.triangle_tests += facet_counts.triangle_tests;
  stats.exact_predicates += facet_counts.exact_predicates;
}

void add(StepStats& sum, const StepStats& one) {
#define TACT_ADD(name, text) sum.name += one.name;
  TACT_STEP_COUNTS(TACT_ADD)
  TACT_STEP_TIMES(TACT_ADD)
#undef TACT_ADD
}

}  // namespace tact

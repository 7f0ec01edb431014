// Counts and times of a step.
#pragma once

#include <cstdint>

namespace tact {

/// Counts and times of one step; kStepCounts and kStepTimes have a sentence on each. Only facet_box_pairs,
/// triangle_tests and exact_predicates depend on the number of threads.
struct StepStats {
  std::int64_t bodies = 0;
  std::int64_t moved_bodies = 0;
  std::int64_t vertices = 0;
  std::int64_t moved_vertices = 0;
  std::int64_t placed_bodies = 0;
  std::int64_t regrouped_bodies = 0;
  std::int64_t excluded_pairs = 0;
  std::int64_t named_excluded_pairs = 0;
  std::int64_t candidate_pairs = 0;
  std::int64_t kept_pairs = 0;
  std::int64_t kdop_separated_pairs = 0;
  std::int64_t still_separated_pairs = 0;
  std::int64_t still_overlapping_pairs = 0;
  std::int64_t separated_pairs = 0;
  std::int64_t contacts = 0;
  std::int64_t carried_directions = 0;
  std::int64_t fresh_directions = 0;
  std::int64_t smallest_directions = 0;
  std::int64_t direction_iterations = 0;
  std::int64_t gjk_iterations = 0;
  std::int64_t limits_reached = 0;
  std::int64_t clusters = 0;
  std::int64_t clusters_outside_box = 0;
  std::int64_t clusters_outside_slab = 0;
  std::int64_t opened_clusters = 0;
  std::int64_t opened_facets = 0;
  std::int64_t facets = 0;
  std::int64_t facets_facing_away = 0;
  std::int64_t facets_outside_slab = 0;
  std::int64_t facets_outside_box = 0;
  std::int64_t facets_outside_zone = 0;
  std::int64_t kept_facets = 0;
  std::int64_t cluster_pairs = 0;
  std::int64_t tree_pairs = 0;
  std::int64_t facet_box_pairs = 0;
  std::int64_t triangle_tests = 0;
  std::int64_t exact_predicates = 0;
  std::int64_t facet_pairs = 0;
  std::int64_t points = 0;
  std::int64_t within_reach = 0;
  std::int64_t point_limits_reached = 0;
  std::int64_t touching_contacts = 0;

  // Milliseconds. Those of stages 3 to 6 are sums over threads; the others are wall times and add up to the step.
  double refresh_ms = 0.0;
  double regroup_ms = 0.0;
  double sweep_ms = 0.0;
  double hulls_ms = 0.0;
  double kdop_ms = 0.0;
  double gjk_ms = 0.0;
  double direction_ms = 0.0;
  double cull_ms = 0.0;
  double confirm_ms = 0.0;
  double narrow_phase_ms = 0.0;
  double containment_ms = 0.0;
  double curves_ms = 0.0;
  double points_ms = 0.0;
  double self_facets_ms = 0.0;
  double self_points_ms = 0.0;
  double within_reach_ms = 0.0;
  double patches_ms = 0.0;
  double report_ms = 0.0;
  double total_ms = 0.0;
};

/// A field of StepStats: its name, its place and a sentence on it.
template <class Value>
struct StepStatsField {
  const char* name;
  Value StepStats::*value;
  const char* text;
};

/// All counts, in the order of the struct.
inline constexpr StepStatsField<std::int64_t> kStepCounts[] = {
    {"bodies", &StepStats::bodies, "bodies in the world"},
    {"moved_bodies", &StepStats::moved_bodies,
     "bodies that were added or whose positions, pose, layers or motion changed"},
    {"vertices", &StepStats::vertices, "vertices of the bodies in the world"},
    {"moved_vertices", &StepStats::moved_vertices, "vertices of the moved bodies"},
    {"placed_bodies", &StepStats::placed_bodies,
     "rigid bodies whose vertices were computed from their pose, as others came near"},
    {"regrouped_bodies", &StepStats::regrouped_bodies,
     "moved bodies whose clusters had lost their shape: their facets were grouped again"},
    {"excluded_pairs", &StepStats::excluded_pairs,
     "overlapping boxes, one moved, that layers, groups or two fixed bodies exclude"},
    {"named_excluded_pairs", &StepStats::named_excluded_pairs,
     "overlapping boxes of pairs that World::set_excluded() excludes"},
    {"candidate_pairs", &StepStats::candidate_pairs, "pairs of bodies whose boxes overlap"},
    {"kept_pairs", &StepStats::kept_pairs, "candidate pairs in which neither body moved: the last result was kept"},
    {"kdop_separated_pairs", &StepStats::kdop_separated_pairs,
     "new pairs, or apart before, whose 18-DOPs an axis separates"},
    {"still_separated_pairs", &StepStats::still_separated_pairs,
     "pairs that the last separating direction still separates"},
    {"still_overlapping_pairs", &StepStats::still_overlapping_pairs,
     "pairs whose hulls the last step's vertices still show to overlap"},
    {"separated_pairs", &StepStats::separated_pairs, "other pairs whose hulls GJK found to be apart"},
    {"contacts", &StepStats::contacts,
     "pairs whose hulls overlap or are nearer than their margins, and bodies that touch or near themselves"},
    {"carried_directions", &StepStats::carried_directions, "contact directions found from the last step's"},
    {"fresh_directions", &StepStats::fresh_directions,
     "contact directions found from the one that separated the hulls before"},
    {"smallest_directions", &StepStats::smallest_directions, "contact directions that are the smallest separation"},
    {"direction_iterations", &StepStats::direction_iterations, "shifted calls of GJK"},
    {"gjk_iterations", &StepStats::gjk_iterations, "support queries of GJK, a vertex of each body"},
    {"limits_reached", &StepStats::limits_reached, "pairs in which GJK or the direction stopped at a limit"},
    {"clusters", &StepStats::clusters, "clusters of the bodies in contact, once a contact"},
    {"clusters_outside_box", &StepStats::clusters_outside_box,
     "clusters dropped whole: outside the box of what is left of the other"},
    {"clusters_outside_slab", &StepStats::clusters_outside_slab,
     "clusters dropped whole by criterion 2, outside the slab"},
    {"opened_clusters", &StepStats::opened_clusters, "clusters of which a cluster of the other body is near"},
    {"opened_facets", &StepStats::opened_facets, "facets of the opened clusters: those dropped next, and those kept"},
    {"facets", &StepStats::facets, "facets of the bodies in contact, once a contact"},
    {"facets_facing_away", &StepStats::facets_facing_away, "facets dropped by criterion 1, facing away (paper only)"},
    {"facets_outside_slab", &StepStats::facets_outside_slab, "facets dropped by criterion 2, outside the slab"},
    {"facets_outside_box", &StepStats::facets_outside_box,
     "other facets dropped: outside the box of what is left of the other"},
    {"facets_outside_zone", &StepStats::facets_outside_zone, "facets dropped by criterion 3, outside the impact zone"},
    {"kept_facets", &StepStats::kept_facets, "facets left after the criteria"},
    {"cluster_pairs", &StepStats::cluster_pairs, "pairs of clusters whose boxes overlap and that no plane separates"},
    {"tree_pairs", &StepStats::tree_pairs, "contacts whose cluster pairs were found by trees rather than a plain loop"},
    {"facet_box_pairs", &StepStats::facet_box_pairs, "pairs of facets whose boxes overlap or nearly do"},
    {"triangle_tests", &StepStats::triangle_tests, "pairs of facets that doubles could not decide"},
    {"exact_predicates", &StepStats::exact_predicates, "orientation predicates that needed integers"},
    {"facet_pairs", &StepStats::facet_pairs, "pairs of facets that meet"},
    {"points", &StepStats::points, "contact points"},
    {"within_reach", &StepStats::within_reach, "pairs of features within reach: see Contact::within_reach()"},
    {"point_limits_reached", &StepStats::point_limits_reached,
     "contacts some of whose points are missing: see Contact::point_limit_reached"},
    {"touching_contacts", &StepStats::touching_contacts, "contacts that touch: see Contact::touching()"},
};

/// All times, milliseconds.
inline constexpr StepStatsField<double> kStepTimes[] = {
    {"refresh_ms", &StepStats::refresh_ms, "stage 1: setting positions since the last step, and grouping facets again"},
    {"regroup_ms", &StepStats::regroup_ms, "the part of stage 1 in which facets were grouped again"},
    {"sweep_ms", &StepStats::sweep_ms, "stage 2: candidate pairs"},
    {"hulls_ms", &StepStats::hulls_ms,
     "stage 3: whether the hulls overlap, summed over threads, with the way to the next pair"},
    {"kdop_ms", &StepStats::kdop_ms, "the part of stage 3 in which the 18-DOPs are compared, once for all threads"},
    {"gjk_ms", &StepStats::gjk_ms, "the part of stage 3 in which pairs needed GJK"},
    {"direction_ms", &StepStats::direction_ms, "stage 4: contact direction and depth, summed over threads"},
    {"cull_ms", &StepStats::cull_ms, "stage 5: zones and criteria, summed over threads"},
    {"confirm_ms", &StepStats::confirm_ms, "stage 6: facet pairs, summed over threads"},
    {"narrow_phase_ms", &StepStats::narrow_phase_ms, "stages 3 to 6 together, wall time"},
    {"containment_ms", &StepStats::containment_ms, "bodies that are wholly inside others, wall time"},
    {"curves_ms", &StepStats::curves_ms, "intersection curves, wall time"},
    {"points_ms", &StepStats::points_ms, "contact points of pairs of bodies, wall time"},
    {"self_facets_ms", &StepStats::self_facets_ms, "facet pairs of bodies with themselves, wall time"},
    {"self_points_ms", &StepStats::self_points_ms, "contact points of bodies with themselves, wall time"},
    {"within_reach_ms", &StepStats::within_reach_ms, "pairs of features within reach, wall time"},
    {"patches_ms", &StepStats::patches_ms, "patches, wall time"},
    {"report_ms", &StepStats::report_ms, "stage 7: the report"},
    {"total_ms", &StepStats::total_ms, "the whole step, refresh included"},
};

/// Calls visit(name, sentence, value) for each count of `stats`, a std::int64_t.
template <class Stats, class Visit>
void for_each_count(Stats&& stats, Visit&& visit) {
  for (const auto& field : kStepCounts) visit(field.name, field.text, stats.*field.value);
}

/// Calls visit(name, sentence, value) for each time of `stats`, a double.
template <class Stats, class Visit>
void for_each_time(Stats&& stats, Visit&& visit) {
  for (const auto& field : kStepTimes) visit(field.name, field.text, stats.*field.value);
}

}  // namespace tact

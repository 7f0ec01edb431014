// What a step did and how long it took: a plain struct, filled anew by every step.
#pragma once

#include <cstdint>

namespace tact {

// Every count of a step, with a sentence on each: the one list that printing, JSON, CSV and averages are made from.
// facet_box_pairs, triangle_tests and exact_predicates depend on how a large pair is shared, and so on threads.
#define TACT_STEP_COUNTS(X)                                                                               \
  X(bodies, "bodies in the world")                                                                        \
  X(moved_bodies, "bodies that were added or whose positions, layers or motion changed")                  \
  X(vertices, "vertices of the bodies in the world")                                                      \
  X(moved_vertices, "vertices of the moved bodies")                                                       \
  X(regrouped_bodies, "moved bodies whose clusters had lost their shape: their facets were grouped anew") \
  X(excluded_pairs, "overlapping boxes, one moved, that layers, groups or two fixed bodies exclude")      \
  X(named_excluded_pairs, "overlapping boxes of pairs that World::set_excluded() excludes")               \
  X(candidate_pairs, "pairs of bodies whose boxes overlap")                                               \
  X(kept_pairs, "candidate pairs in which neither body moved: the last result was kept")                  \
  X(parted_pairs, "new pairs, or apart before, that are apart along a diagonal of a cube's face")         \
  X(still_separated_pairs, "pairs that the last separating direction still separates")                    \
  X(still_overlapping_pairs, "pairs whose hulls the last step's vertices still show to overlap")          \
  X(separated_pairs, "other pairs whose hulls GJK found to be apart")                                     \
  X(contacts, "pairs whose hulls overlap")                                                                \
  X(carried_directions, "contact directions found from the last step's")                                  \
  X(fresh_directions, "contact directions found from the one that separated the hulls before")            \
  X(smallest_directions, "contact directions that are the smallest separation")                           \
  X(direction_iterations, "shifted calls of GJK")                                                         \
  X(gjk_iterations, "support queries of GJK, a vertex of each body")                                      \
  X(limits_reached, "pairs in which GJK or the direction stopped at a limit")                             \
  X(clusters, "clusters of the bodies in contact, once a contact")                                        \
  X(clusters_outside_box, "clusters dropped whole: outside the box of what is left of the other")         \
  X(clusters_outside_slab, "clusters dropped whole by criterion 2, outside the slab")                     \
  X(opened_clusters, "clusters of which a cluster of the other body is near")                             \
  X(opened_facets, "facets of the opened clusters: those dropped next, and those kept")                   \
  X(facets, "facets of the bodies in contact, once a contact")                                            \
  X(facets_facing_away, "facets dropped by criterion 1, facing away (paper only)")                        \
  X(facets_outside_slab, "facets dropped by criterion 2, outside the slab")                               \
  X(facets_outside_box, "other facets dropped: outside the box of what is left of the other")             \
  X(facets_outside_zone, "facets dropped by criterion 3, outside the impact zone")                        \
  X(kept_facets, "facets left after the criteria")                                                        \
  X(cluster_pairs, "pairs of clusters whose boxes overlap")                                               \
  X(tree_pairs, "contacts whose cluster pairs were found by trees rather than a plain loop")              \
  X(facet_box_pairs, "pairs of facets whose boxes overlap or nearly do")                                  \
  X(triangle_tests, "pairs of facets that doubles could not decide")                                      \
  X(exact_predicates, "orientation predicates that needed integers")                                      \
  X(facet_pairs, "pairs of facets that meet")                                                             \
  X(touching_contacts, "contacts with at least one facet pair")

// Every time of a step, in milliseconds. The stages 3 to 6 run pair by pair on all threads: theirs are sums over
// threads.
#define TACT_STEP_TIMES(X)                                                                         \
  X(refresh_ms, "stage 1: setting positions since the last step, and grouping facets anew")        \
  X(regroup_ms, "the part of stage 1 in which facets were grouped anew")                           \
  X(sweep_ms, "stage 2: candidate pairs")                                                          \
  X(hulls_ms, "stage 3: do the hulls overlap, summed over threads; and from one pair to the next") \
  X(parting_ms, "the part of stage 3 in which diagonals are asked, once for all threads")          \
  X(gjk_ms, "that part of stage 3 in which pairs needed GJK")                                      \
  X(direction_ms, "stage 4: contact direction and depth, summed over threads")                     \
  X(cull_ms, "stage 5: zones and criteria, summed over threads")                                   \
  X(confirm_ms, "stage 6: facet pairs, summed over threads")                                       \
  X(narrow_phase_ms, "stages 3 to 6 together and patches, wall time")                              \
  X(report_ms, "stage 7: the report")                                                              \
  X(total_ms, "the whole step, refresh included")

struct StepStats {
#define TACT_FIELD(name, text) std::int64_t name = 0;
  TACT_STEP_COUNTS(TACT_FIELD)
#undef TACT_FIELD
#define TACT_FIELD(name, text) double name = 0.0;
  TACT_STEP_TIMES(TACT_FIELD)
#undef TACT_FIELD
};

// Calls visit(name, description, value) for every count of `stats`, a std::int64_t each.
template <class Stats, class Visit>
void for_each_count(Stats&& stats, Visit&& visit) {
#define TACT_FIELD(name, text) visit(#name, text, stats.name);
  TACT_STEP_COUNTS(TACT_FIELD)
#undef TACT_FIELD
}

// Calls visit(name, description, value) for every time of `stats`, a double in milliseconds each.
template <class Stats, class Visit>
void for_each_time(Stats&& stats, Visit&& visit) {
#define TACT_FIELD(name, text) visit(#name, text, stats.name);
  TACT_STEP_TIMES(TACT_FIELD)
#undef TACT_FIELD
}

}  // namespace tact

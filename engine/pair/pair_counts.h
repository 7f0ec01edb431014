// What pairs cost: counts and times of stages 3 to 6. Every thread counts its pairs into one of these; `+=` adds them.
#pragma once

#include <cstdint>

#include "narrowphase/criteria/criteria.h"
#include "narrowphase/triangles/confirm.h"

namespace tact {

/// Counts are of pairs where nothing else is said; times are milliseconds.
struct PairCounts {
  // Stage 3
  std::int64_t still_separated = 0;    ///< by the direction that separated the hulls in the last step
  std::int64_t still_overlapping = 0;  ///< shown by the vertices that showed it in the last step
  std::int64_t separated = 0;          ///< other pairs whose hulls are apart
  std::int64_t limits_reached = 0;     ///< in GJK, or in the search for the direction
  std::int64_t gjk_iterations = 0;     ///< support queries, a vertex of each body
  // Stage 4
  std::int64_t direction_iterations = 0;  ///< shifted calls of GJK
  std::int64_t carried_directions = 0;
  std::int64_t fresh_directions = 0;
  std::int64_t smallest_directions = 0;
  // Stage 5: clusters and facets of both bodies, once a contact
  std::int64_t clusters = 0;
  std::int64_t clusters_outside_box = 0;
  std::int64_t clusters_outside_slab = 0;
  std::int64_t facets = 0;
  std::int64_t cluster_pairs = 0;
  std::int64_t tree_pairs = 0;  ///< pairs of bodies whose cluster pairs were found by trees
  // Stage 6
  narrowphase::CullCounts cull;        ///< facets of opened clusters, a cluster once a contact
  narrowphase::ConfirmCounts confirm;  ///< facet pairs
  // Times
  double hulls_ms = 0.0;
  double gjk_ms = 0.0;  ///< the part of hulls_ms of pairs that needed GJK
  double direction_ms = 0.0;
  double cull_ms = 0.0;
  double confirm_ms = 0.0;

  PairCounts& operator+=(const PairCounts& other);
};

}  // namespace tact

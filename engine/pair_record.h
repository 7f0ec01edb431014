// What a pair of bodies keeps from step to step, for as long as it is a candidate.
#pragma once

#include <tact/report.h>
#include <tact/trace.h>

#include <memory>
#include <optional>
#include <vector>

#include "narrowphase/gjk.h"
#include "narrowphase/star_surface.h"

namespace tact {

// What the last step says about the direction: where the next one starts.
struct PairHistory {
  enum class Kind { none, separated, overlapping } kind = Kind::none;
  base::Vec3 direction;           // unit, from a to b: separates the hulls, or is their contact direction
  narrowphase::GjkSimplex hulls;  // where GJK on the hulls ended
  narrowphase::GjkSimplex face;   // the face of the Minkowski difference that held the foot
  bool has_surface = false;       // PairRecord::surface is of the last step
};

// What happened in the last step that looked at the pair.
struct PairCounts {
  std::int64_t gjk_iterations = 0;
  std::int64_t clusters = 0;  // of both bodies
  std::int64_t clusters_outside_box = 0;
  std::int64_t clusters_outside_slab = 0;
  std::int64_t opened_clusters = 0;
  std::int64_t opened_facets = 0;
  std::int64_t facets_facing_away = 0;
  std::int64_t facets_outside_zone = 0;
  std::int64_t cluster_pairs = 0;
  std::int64_t facet_box_pairs = 0;
  std::int64_t triangle_tests = 0;
  std::int64_t exact_predicates = 0;
  bool still_separated = false;
  bool still_overlapping = false;
  bool used_trees = false;
  bool limit_reached = false;
  bool in_ranges = false;  // stage 6 was cut into ranges, for all threads
  int thread = 0;          // that looked at the pair, from `begin` on
  TraceEvent::Time begin;
  double hulls_ms = 0.0, direction_ms = 0.0, cull_ms = 0.0, confirm_ms = 0.0;
};

struct PairRecord {
  BodyId a, b;
  PairHistory history;
  bool hulls_overlap = false;
  Contact contact;                     // if hulls_overlap
  std::vector<FacetPair> facet_pairs;  // sorted
  std::vector<Patch> patches;
  std::unique_ptr<narrowphase::SurfaceShape>
      surface;  // where the search for the smallest separation ended, once there was one
  PairCounts counts;
  bool touched = false;  // in the step before this one
};

}  // namespace tact

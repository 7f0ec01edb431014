// What a pair of bodies keeps from step to step, for as long as it is a candidate.
#pragma once

#include <tact/report.h>
#include <tact/trace.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/curve_set.h"
#include "engine/patch_set.h"
#include "narrowphase/depth/star_surface.h"
#include "narrowphase/hull/gjk.h"
#include "narrowphase/triangles/surface_history.h"

namespace tact {

/// What the last step that looked at the pair says about the direction: where the next one starts. Pairs that
/// separate_by_kdop() settles are not looked at.
struct PairHistory {
  enum class Kind : std::uint8_t { none, separated, overlapping };
  base::Vec3 direction;           ///< unit, from a to b: separates the hulls, or is their contact direction
  narrowphase::GjkSimplex hulls;  ///< where GJK on the hulls ended
  Kind kind = Kind::none;
  bool has_surface = false;  ///< PairRecord::surface is of the last step
};

/// When the last step looked at the pair, and for how long: for the trace.
struct PairTimes {
  TraceEvent::Time begin;  ///< if Outputs::trace is set
  float hulls_ms = 0.0f;
  float direction_ms = 0.0f;
  float cull_ms = 0.0f;
  float confirm_ms = 0.0f;
  std::int32_t thread = 0;  ///< that looked at the pair, from `begin` on
  bool in_ranges = false;   ///< stage 6 was cut into ranges, for all threads
};

/// Most pairs are apart: what these need comes first, in few lines of memory.
struct alignas(64) PairRecord {
  BodyId a, b;
  bool hulls_overlap = false;
  bool near = false;            ///< the hulls are apart by less than the sum of the margins
  bool was_in_contact = false;  ///< in the step before: last_points are of that
  bool touching = false;        ///< see is_touching()
  PairHistory history;
  PairTimes times;
  // Of pairs whose hulls overlap; for others the vectors are empty and the rest is old.
  double slab_lower = 0.0;  ///< see narrowphase::Slab: the planes of `contact` are rounded once more
  double slab_upper = 0.0;
  narrowphase::GjkSimplex face;  ///< of the Minkowski difference, which the contact direction ended on in the last step
  Contact contact;
  std::vector<FacetPair> facet_pairs;                     ///< sorted
  std::vector<ContactPoint> points;                       ///< of pairs in contact, sorted
  std::vector<ContactPoint> last_points;                  ///< of the step before
  std::vector<ReachPair> within_reach;                    ///< of pairs in contact, sorted
  std::unique_ptr<PatchMemory> patches;                   ///< made when there are any
  std::unique_ptr<CurveSet> curves;                       ///< of the last step; null where no facets meet
  std::unique_ptr<narrowphase::SurfaceHistory> surfaces;  ///< of bodies that lie on each other, once
  std::unique_ptr<narrowphase::SurfaceShape> surface;     ///< where the search for the smallest separation ended, once
  bool is_renumbered = false;  ///< facets have changed since: last_points are those of the last step, by new numbers
  std::vector<FacetPair> bare_pairs;  ///< of edges and points, with each other and with facets; sorted
};

/// Whether surfaces, edges or points share a point.
inline bool any_meet(const PairRecord& record) { return !record.facet_pairs.empty() || !record.bare_pairs.empty(); }

inline bool in_contact(const PairRecord& record) { return record.hulls_overlap || record.near; }

}  // namespace tact

// Which facets of two overlapping bodies can touch (paper §3): clusters first, then facets.
//
// A facet F of A, n the contact direction (B the same with -n):
//   1 facing away     n · normal(F) <= 0: dropped. Loses contacts on spikes and folds: Accuracy::paper only, and
//                     never on a sheet or a facet without area.
//   2 outside slab    F lies before the plane of B.
//     outside box     F's box misses the box of what is left of B. It is not the paper's, and costs as little.
//   3 outside zone    the projection of F misses the disk around B's impact zone. Where a zone was computed.
//
// Criteria 2 and 3 lose no contact in real arithmetic, and none here. A height computed as n · (x - origin) is off by
// at most e = Slab::error from the true one; so is a plane, which is the extreme of such heights. A facet is dropped
// only if its highest corner lies more than 2 e, rounded downwards, below the plane: then it lies below in truth. Boxes
// are exact. For the disk see impact_zone.h; the facet's projection is off by at most sqrt(2) e more.
#pragma once

#include <cstdint>

#include "narrowphase/criteria/impact_zone.h"
#include "narrowphase/pairs/kept_clusters.h"

namespace tact::narrowphase {

// How the facets of one body are judged against the other.
struct Criteria {
  Vec3 outward = {};         // n for A, -n for B
  Vec3 origin = {};          // heights are measured from here
  double lowest = 0.0;       // a facet whose highest corner is lower cannot touch; all margins included, metres
  bool facing_away = false;  // criterion 1 applies
  bool zone = false;         // criterion 3 applies
  Vec3 u = {}, v = {};       // axes of the zone's plane, of equal length
  Disk other_zone = {};      // of the other body, all margins included, in units of that length
};

// How many facets were kept, and dropped by each criterion. The first that drops a facet counts: criterion 2, the box,
// 1, 3. The first two need only its corners.
struct CullCounts {
  std::int64_t opened_clusters = 0;
  std::int64_t facing_away = 0;
  std::int64_t outside_slab = 0;
  std::int64_t outside_box = 0;
  std::int64_t outside_zone = 0;
  std::int64_t kept = 0;
  std::int64_t kept_bare = 0;  // edges and points among these, which are facets without area

  std::int64_t facets() const { return facing_away + outside_slab + outside_box + outside_zone + kept; }
  std::int64_t kept_of_surface() const { return kept - kept_bare; }
  CullCounts& operator+=(const CullCounts& one);
};

// The criteria for A and for B. `zone_a` and `zone_b` may be null: criterion 3 is then not applied.
Criteria criteria_for_a(const Slab& slab, const ImpactZone* zone_b, bool facing_away);
Criteria criteria_for_b(const Slab& slab, const ImpactZone* zone_a, bool facing_away);

// The clusters of `mesh` that reach up to the other's plane, the others being too low, and whose box meets `other`.
// Replaces the contents of `kept`.
void cull_clusters(const ClusteredMesh& mesh, const Criteria& criteria, const Box& other, KeptClusters& kept);

// Facets that may touch, of one or more clusters.
struct KeptFacets {
  FacetBlock block;
  std::uint64_t facets = 0;  // a bit for each of the block that the criteria leave
  Box bounds;                // of their clusters

  void clear() {
    block.count = block.cells.count = 0;
    facets = 0;
    bounds = {};
  }
};

// Appends the facets of a cluster that the criteria and the box `other` leave. Returns false, and changes nothing, if
// the block has no room for them; an empty one has room for any cluster.
bool append_facets(const ClusteredMesh& mesh, int cluster, const Criteria& criteria, const Box& other, KeptFacets& kept,
                   CullCounts& counts);

}  // namespace tact::narrowphase

// Queries to one mesh, as it is now: segments, nearest points, boxes, what is inside. They descend from the boxes of
// groups to those of clusters to facets; nothing is built. Segments meet the facets of the surface alone, and these
// alone have an inside: see WithoutArea.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "narrowphase/distance/vertex_facet.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/mesh/features.h"
#include "narrowphase/queries/prepared_segment.h"

namespace tact::narrowphase {

/// A facet, by the caller's number, that a segment meets, as closed sets; decided exactly (triangle_triangle.h).
struct FacetHit {
  int facet = -1;
  double time = 0.0;               // of the first common point, as a part of the segment: the exact one, rounded once
  std::array<double, 3> weight{};  // of the facet's corners there

  /// By time, then by facet.
  friend bool operator<(const FacetHit& x, const FacetHit& y) {
    return x.time < y.time || (x.time == y.time && x.facet < y.facet);
  }
};

/// The first facet that the segment meets, not later than `latest`.
std::optional<FacetHit> first_hit(const ClusteredMesh& mesh, const PreparedSegment& line, double latest);
/// Any of them.
std::optional<FacetHit> any_hit(const ClusteredMesh& mesh, const PreparedSegment& line);
/// Appends all of them, in no particular order.
void append_hits(const ClusteredMesh& mesh, const PreparedSegment& line, std::vector<FacetHit>& hits);

struct NearestFacet {
  int facet = -1;                  // the caller's number; of equally near ones the least
  double distance = 0.0;           // the exact one, rounded once
  std::array<double, 3> weight{};  // of the facet's corners at the nearest point
};

/// The weights of a facet's corners as the caller has them: corners that are one vertex of his count as one.
std::array<double, 3> weights_of_source(const ClusteredMesh& mesh, int source_facet,
                                        const std::array<double, 3>& weight);

/// The facet nearest to a point, if its rounded distance is at most `within`, metres.
std::optional<NearestFacet> nearest_facet(const ClusteredMesh& mesh, Vec3 point, double within);

/// Appends the facets, by the caller's numbers, that share a point with a box, as closed sets; decided exactly.
void append_facets_in_box(const ClusteredMesh& mesh, const Box& box, std::vector<int>& facets);

/// True if the point is inside a closed mesh or on its surface. Decided exactly, by how often the surface winds around
/// it: a half-line along x, moved off all edges by amounts that are smaller than any number (Edelsbrunner and Mücke,
/// "Simulation of Simplicity", 1990), counts the facets that it leaves through minus those that it enters through.
/// Where the mesh has holes the answer is that of some filling.
bool contains(const ClusteredMesh& mesh, Vec3 point);

/// Whether a mesh lies wholly inside a closed one, of which it meets no facets. Exact.
bool lies_inside(const ClusteredMesh& inner, const ClusteredMesh& outer);
/// The same of a mesh whose parts are known.
bool lies_inside(const FeaturedMesh& inner, const ClusteredMesh& outer);

}  // namespace tact::narrowphase

// Which facets of two bodies meet, by CGAL: boxes by box_intersection_d, triangles by do_intersect with exact
// predicates. It shares no code with the engine. Facets are closed sets; one without area is the segment or the point
// that it is.
#pragma once

#include <tact/facet_pair.h>

#include <optional>
#include <span>
#include <vector>

#include "tests/support/mesh.h"

namespace tact::tests {

// The facets of a and of b that share at least one point, sorted.
std::vector<FacetPair> facet_pairs_by_oracle(const Mesh& a, const Mesh& b);

// The same by a plain loop over all pairs, for small meshes: the oracle of the oracle.
std::vector<FacetPair> facet_pairs_by_brute_force(const Mesh& a, const Mesh& b);

// The facets of one mesh that meet, a < b, sorted: those that name no common vertex and share a point; and those that
// share one beyond the vertices that they name both and the edge between two of them.
std::vector<FacetPair> self_facet_pairs_by_oracle(const Mesh& mesh);

// The same by CGAL's Polygon_mesh_processing::self_intersections. Nothing where CGAL cannot hold the mesh: where an
// edge has three facets, facets beside each other turn opposite ways, or a facet has no area.
std::optional<std::vector<FacetPair>> self_facet_pairs_by_cgal(const Mesh& mesh);

// Two bodies whose facets meet.
struct MeetingBodies {
  int a = -1;  // a < b
  int b = -1;
  std::vector<FacetPair> facet_pairs;  // sorted, not empty
  friend bool operator==(const MeetingBodies&, const MeetingBodies&) = default;
};

// All bodies whose facets meet, sorted by (a, b): one sweep over the facets of all.
std::vector<MeetingBodies> meeting_bodies_by_oracle(std::span<const Mesh> bodies);

}  // namespace tact::tests

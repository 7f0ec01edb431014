// Contact points where two surfaces cross: their gaps are negative.
//
// Into a closed mesh. Each vertex of the other that is inside it, decided exactly, has one point: the way from it to
// the surface. It leads to the nearest place among the facets
//   1. whose outward normals are within 60 degrees of the normal that the vertex's point had in the last step; or, if
//      there was none, or none of them is as near as the hulls are deep,
//   2. that face the direction of the vertex's patch: the mean of the normals that its vertices had in the last step,
//      those of negative gaps if there are any; or else the mean normal of the facets through which its edges come in,
//      if these agree; or else the contact direction; or, if none of them is near enough,
//   3. that are met first along the contact direction, which is never farther than the hulls are deep.
// So a shallow vertex has its distance to the surface, and a deep one keeps the side that it came from. A vertex that
// had a positive gap keeps its normal only if it is not against its patch's: one that has come out on the far side of a
// thin part, and goes in again, goes back with the others.
//
// Through a sheet. A vertex whose edge the sheet cuts, and which is on the other side than its normal in the last step
// says, or that of its patch, has one point: its distance to the sheet, negative. If these had none, of a closed mesh
// the ways out of it tell that corners of the sheet have which were not in it before, where these agree; or else the
// contact direction. Vertices around it have one as far as they are on that side, by their own normal of the last step
// if its gap was positive, above the inside of the sheet and not deeper than the hulls.
//
// A patch is, for either mesh, what facets that meet join, and what is inside and hangs together with it.
//
// Between two edges that have passed each other: the facets at either lie as in nearest.h, seen along the normal, but
// the closest points have changed places. There is a point, however deep, if one of the edges meets a facet that has
// the other. An edge that runs through a closed mesh, both ends outside, and has no such point, has one with the
// nearest edge of the mesh for which its closest point is inside, if there is one. Where facets lie level with the
// edges, as in a box on a floor, edges that go on inside keep the point that they had outside while they are nearer
// than the margins.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/contact_points/contact_points.h"
#include "narrowphase/contact_points/cut.h"
#include "narrowphase/contact_points/running_edge.h"
#include "narrowphase/contact_points/vertex_places.h"
#include "narrowphase/contact_points/waiting_edges.h"
#include "narrowphase/contact_points/way_out.h"

namespace tact::narrowphase {

/// What a vertex, by the caller's number, remembers of the last step: the normal of its point, from a to b.
struct CarriedNormal {
  int vertex = -1;
  Vec3 normal;
  double gap = 0.0;  // it had, metres
};

enum class SurfaceKind { closed, sheet };

/// Two meshes whose hulls overlap, in the words of the caller.
struct CrossingInput {
  FeaturedMesh a, b;
  SurfaceKind surface_a = SurfaceKind::closed, surface_b = SurfaceKind::closed;
  Vec3 direction;      // of the contact, unit, from a to b
  double depth = 0.0;  // of the hulls, metres
  std::span<const FacetPair> facet_pairs;
  std::span<const CarriedNormal> carried_a, carried_b;  // sorted by vertex, each once
};

/// Is every vertex of a mesh inside the closed one `outer`? Exact, for meshes of which no facets meet.
bool is_contained(const FeaturedMesh& inner, const ClusteredMesh& outer);

/// Memory for it, used again.
class CrossingSearch {
 public:
  /// Finds the vertices that have crossed; valid until the next call. What `input` refers to stays until finish().
  CrossedVertices begin(const CrossingInput& input);
  /// Takes the points within the margins that ContactPointSearch has found, all but those of vertices that have
  /// crossed; gives those of edges that have crossed their new gaps, takes out the ones that are none, and appends what
  /// is deeper.
  void finish(std::vector<FeaturePoint>& found);

 private:
  struct Crossed {
    int source_vertex = -1;
    WayOut way;
  };
  /// One of the two meshes, and what of it has crossed the other.
  struct Side {
    FeaturedMesh mesh;
    SurfaceKind surface = SurfaceKind::closed;
    std::span<const CarriedNormal> carried;
    double sign = 1.0;  // times a way out of the other mesh: the normal from a to b
    Cut cut;
    VertexPlaces carried_at;                 // in `carried`
    std::vector<Crossed> crossed;            // sorted by vertex
    VertexPlaces crossed_at;                 // in `crossed`, when it is whole
    std::vector<std::uint64_t> has_crossed;  // a bit for each vertex, by the mesh's numbers

    ScaledMesh scaled(double scale) const { return {*mesh.mesh, *mesh.features, scale}; }
    const CarriedNormal* carried_normal(int source_vertex) const;
    const Crossed* find(int source_vertex) const;
    void mark_crossed();
  };
  /// What a patch of vertices knows of its direction: sums of unit vectors out of the other mesh.
  struct PatchDirection {
    Vec3 of_crossed, of_others, entered;
    int entries = 0;
    Vec3 facing;
  };
  struct Reached {
    int source_vertex, vertex;
    int from;  // which vertex it was reached from, by the caller's number; -1: from an edge that is cut
    Vec3 facing;
    int hint;  // a facet that is near it
  };

  void find_crossed(Side& own, const Side& other);
  void find_ways_out(Side& own, const Side& other);
  void find_patch_directions(Side& own, const Side& other);
  Vec3 facing_of_patch(const Side& own, int source_vertex) const;
  std::optional<Vec3> facing_of_vertex(const Side& own, int source_vertex, SurfaceKind other) const;
  void find_ways_through(Side& own, const Side& sheet);
  void reach_through(Side& own);
  const WayThrough* way_through(const Reached& one, const ScaledMesh& from);
  void spread_through(Side& own);
  void append_vertex_points(const Side& own, const Side& other, std::vector<FeaturePoint>& found) const;
  bool have_passed(int edge_a, int edge_b, const FeaturePoint& point) const;
  bool goes_on_inside(const Side& own, int edge) const;
  bool meets_beside(const Side& own, int edge, const Side& other, int other_edge) const;
  Vec3 facing_of_edges(int edge_a, int edge_b) const;
  bool passed_point(int edge_a, int edge_b, FeaturePoint& point) const;
  void sign_edges(std::vector<FeaturePoint>& found);
  template <class Visit>
  void wait(int edge_a, int edge_b, const Visit& visit);
  template <class Visit>
  void visit_waiting(const Visit& visit);
  void append_edge_points(std::vector<FeaturePoint>& found);
  void append_running_edges(const Side& own, const Side& other, std::vector<FeaturePoint>& found);
  std::optional<FeaturePoint> nearest_passed(const Side& own, std::span<const EdgeHit> hits, const Side& other);
  bool is_inside(const Side& own, int edge, const std::array<double, 3>& weight, const Side& other) const;

  Side a_, b_;
  EdgeHitSearch edge_hits_;
  WayFinder ways_;
  double scale_ = 1.0, limit_ = 0.0;  // scaled
  Vec3 direction_;
  std::vector<PatchDirection> patches_;
  std::vector<Reached> reached_, next_;
  std::vector<std::optional<WayThrough>> through_;  // of vertices that were reached
  VertexPlaces through_at_;
  std::vector<std::pair<int, int>> known_edges_, candidates_;
  std::vector<int> with_point_;
  WaitingEdges waiting_;
  EdgesBeside beside_running_;
};

}  // namespace tact::narrowphase

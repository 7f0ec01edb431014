// Which vertices of two meshes are past the other one, and their exits.
//
// Inside a closed mesh, decided exactly. The exit leads to the nearest place among the facets
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
// Beyond a sheet. A vertex whose edge the sheet cuts is past it if it is on the other side than its normal in the last
// step says, or that of its patch. If these had none, of a closed mesh the exits that corners of the sheet have which
// were not in it before tell, where these agree; or else the contact direction. The exit is the nearest place of the
// sheet. Vertices connected to such a vertex by edges are past the sheet as far as they are on that side, by their own
// normal of the last step if its gap was positive, above the inside of the sheet and not deeper than the hulls.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "narrowphase/crossing/crossing.h"
#include "narrowphase/crossing/spread_past.h"

namespace tact::narrowphase {

/// What a vertex, by the caller's number, remembers of the last step: the normal of its point, from a to b.
struct CarriedNormal {
  int vertex = -1;
  Vec3 normal;
  double gap = 0.0;  // it had, metres
};

/// Two meshes whose hulls overlap, in the words of the caller.
struct PairCrossingInput {
  FeaturedMesh a, b;
  SurfaceKind surface_a = SurfaceKind::closed, surface_b = SurfaceKind::closed;
  Vec3 direction;      // of the contact, unit, from a to b
  double depth = 0.0;  // of the hulls, metres
  std::span<const FacetPair> facet_pairs;
  std::span<const CarriedNormal> carried_a, carried_b;  // sorted by vertex, each once
};

/// Whether every vertex of a mesh is inside the closed one `outer`. Exact, for meshes of which no facets meet.
bool is_contained(const FeaturedMesh& inner, const ClusteredMesh& outer);

/// Buffers are reused.
class PairCrossing {
 public:
  /// What `input` refers to stays as long as the crossing is used: until the next call.
  const Crossing& find(const PairCrossingInput& input);

 private:
  /// What a patch of vertices knows of its direction: sums of unit vectors out of the other mesh.
  struct PatchDirection {
    Vec3 of_past, of_others, entered;
    int entries = 0;
    Vec3 facing;
  };
  using CarriedNormals = VertexTable<CarriedNormal>;

  void begin(const PairCrossingInput& input);
  void find_past(CrossedSurface& own, const CrossedSurface& other);
  void find_exits(CrossedSurface& own, const CrossedSurface& other);
  void find_exits_through(CrossedSurface& own, const CrossedSurface& sheet);
  std::optional<NearestExit> exit_inside(const CrossedSurface& own, const CrossedSurface& other, int vertex, int hint);
  void find_patch_directions(CrossedSurface& own, const CrossedSurface& other);
  void add_entry(const CrossedSurface& own, const CrossedSurface& other, const EdgeHit& hit, PatchDirection& patch);
  Vec3 facing_of_patch(const CrossedSurface& own, int source_vertex) const;
  std::optional<Vec3> facing_of_vertex(const CrossedSurface& own, int source_vertex, SurfaceKind other) const;
  const CarriedNormals& carried(const CrossedSurface& own) const { return carried_[&own == &crossing_.surfaces[1]]; }

  Crossing crossing_;
  CarriedNormals carried_[2];
  EdgeHitSearch edge_hits_;
  ExitFinder exits_;
  SpreadPast spread_;
  std::vector<PatchDirection> patches_;
  VertexTable<std::optional<ExitThrough>> through_;  // of vertices that were reached
};

}  // namespace tact::narrowphase

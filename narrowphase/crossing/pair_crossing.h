// Which vertices of two meshes are past the other one, and their exits.
//
// Inside a closed mesh, decided exactly. The exit leads to the nearest place among the facets
//   1. whose outward normals are within 60 degrees of the normal that the vertex's point had in the last step; or, if
//      there was none, or none of them is as near as the hulls are deep,
//   2. that face the direction of the vertex's patch: the mean of the normals that its vertices had in the last step,
//      those of negative gaps if there are any; or else the mean normal of the facets through which its edges come in;
//      or, if it has no edges that do, the contact direction. Where these normals do not agree, the direction is that
//      of way_apart.h. If none of these facets is near enough,
//   3. of all.
// So a shallow vertex has its distance to the surface, and a deep one keeps the side that it came from. An exit is
// local:
//   - it is no longer than the mesh is thick there, which is the way from the nearest place through the vertex to the
//     other side. A vertex that had a negative gap may be deeper: up to twice as deep as it was, or deeper by at most
//     that. A longer step does not tell through which side it came; and
//   - where the last step does not name its side, nothing of the mesh is between the vertex and the place.
// Otherwise the exit is that of 3.
// A vertex that had a positive gap keeps its normal only if it is not against its patch's: one that has come out on the
// far side of a thin part, and goes in again, goes back with the others.
//
// Of two closed meshes, a crossing that keeps its direction (kept_directions.h) has no exits against it: a patch whose
// direction is against it faces that way instead. Where no such exit is local, and the nearest one is against it, the
// exit leads to facets within 60 degrees of way_apart.h, which starts from it.
//
// Vertices of two convex bodies that convex_separation.h leads have exits through facets within 60 degrees of its
// direction, or else through those that face it.
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

#include "narrowphase/crossing/convex_separation.h"
#include "narrowphase/crossing/crossing.h"
#include "narrowphase/crossing/crossing_groups.h"
#include "narrowphase/crossing/kept_directions.h"
#include "narrowphase/crossing/spread_past.h"
#include "narrowphase/crossing/way_apart.h"

namespace tact::narrowphase {

/// Two meshes whose hulls overlap, in the words of the caller.
struct PairCrossingInput {
  FeaturedMesh a, b;
  SurfaceKind surface_a = SurfaceKind::closed, surface_b = SurfaceKind::closed;
  Vec3 direction;      // of the contact, unit, from a to b
  double depth = 0.0;  // of the hulls, metres
  std::span<const FacetPair> facet_pairs;
  CarriedPoints carried;
};

/// Buffers are reused.
class PairCrossing {
 public:
  /// What `input` refers to stays as long as the crossing is used: until the next call.
  const Crossing& find(const PairCrossingInput& input);

 private:
  /// What a patch of vertices knows of its direction: sums of unit vectors out of the other mesh.
  struct PatchDirection {
    struct Sum {
      Vec3 sum;
      int count = 0;
      void add(Vec3 normal) { sum = sum + normal, ++count; }
      bool agrees() const { return norm(sum) > kAgree * count; }
    };
    Sum of_past, of_others, entered;
    Vec3 facing;
    bool agrees = false;  // if not, what is inside a closed mesh faces the way apart
  };
  using CarriedNormals = VertexTable<CarriedNormal>;

  void begin(const PairCrossingInput& input);
  void find_groups();
  void find_kept();
  void find_past(CrossedSurface& own, const CrossedSurface& other);
  void find_exits(CrossedSurface& own, const CrossedSurface& other);
  void find_exits_through(CrossedSurface& own, const CrossedSurface& sheet);
  std::optional<NearestExit> exit_inside(const CrossedSurface& own, const CrossedSurface& other, int vertex, int hint);
  std::optional<NearestExit> own_exit_inside(const CrossedSurface& own, const CrossedSurface& other, int vertex,
                                             int hint);
  static bool is_local(const NearestExit& exit, const NearestExit& nearest, const ScaledMesh& other, Vec3 v,
                       const std::optional<double>& last_depth);
  static bool is_thicker(const ScaledMesh& other, Vec3 v, const NearestExit& nearest, double distance);
  static bool is_straight(const ScaledMesh& other, Vec3 v, const NearestExit& nearest, const NearestExit& exit);
  void find_patch_directions(CrossedSurface& own, const CrossedSurface& other);
  void add_entry(const CrossedSurface& own, const CrossedSurface& other, const EdgeHit& hit, PatchDirection& patch);
  Vec3 facing_of_patch(const CrossedSurface& own, int source_vertex) const;
  Vec3 way_apart_of(const CrossedSurface& own, int source_vertex);
  std::optional<Vec3> facing_of_vertex(const CrossedSurface& own, int source_vertex, SurfaceKind other) const;
  const CarriedNormals& carried(const CrossedSurface& own) const { return carried_[&own == &crossing_.surfaces[1]]; }

  Crossing crossing_;
  CarriedNormals carried_[2];
  EdgeHitSearch edge_hits_;
  ExitFinder exits_;
  SpreadPast spread_;
  std::vector<PatchDirection> patches_;
  CrossingGroups groups_;
  KeptDirections kept_;
  ConvexSeparation separation_;
  WayApart way_apart_;
  PartOfSurface part_a_, part_b_;
  std::vector<std::optional<Vec3>> ways_apart_;      // of groups, as far as they were wanted
  VertexTable<std::optional<ExitThrough>> through_;  // of vertices that were reached
};

}  // namespace tact::narrowphase

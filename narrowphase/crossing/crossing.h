// What of two surfaces is past the other one, or what of a mesh is past itself.
//
// PairCrossing finds it for two bodies, SelfCrossing for one: by the edges that meet facets (edge_hits), the patches
// and the vertices past the surface (cut, vertex_winding), the crossings that they are of (crossing_groups) and
// what these keep of the last step (kept_directions), the nearest exit of each vertex (nearest_exit, part_exit,
// spread_past), and the way apart of a whole crossing (way_apart). Then crossing_points makes points of it, for both.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "narrowphase/crossing/crossing_sides.h"
#include "narrowphase/crossing/cut.h"
#include "narrowphase/crossing/nearest_exit.h"
#include "narrowphase/crossing/vertex_table.h"

namespace tact::narrowphase {

/// Facets that stand along a direction to 3 degrees do not face it: rounding would choose between them.
inline constexpr double kFaces = 0.05;
/// A vertex keeps to facets within 60 degrees of its last normal: a wall at a right angle to them stays another side
/// however the body turns in a step.
inline constexpr double kSameSide = 0.5;
/// Normals agree on a direction if their mean is longer: those of a cap of 37 degrees do, of two walls at a right angle
/// they do not.
inline constexpr double kAgree = 0.8;
/// What is nearer to its own mesh touches it: rounding would choose its side. Lengths are near 1.
inline constexpr double kTouches = 1e-12;
/// Beyond both meshes, whose lengths are at most 2.
inline constexpr double kAnywhere = 16.0;

/// A surface, and what of it is past the other one.
struct CrossedSurface {
  FeaturedMesh mesh;
  SurfaceKind surface = SurfaceKind::closed;
  double sign = -1.0;  // times the direction of an exit: the normal from a to b
  double scale = 1.0;
  Cut cut;
  VertexTable<NearestExit> exits;                  // of vertices past the other surface
  std::vector<Vec3> kept;                          // by patch; empty: no crossing keeps a direction
  std::vector<std::uint64_t> without_near_points;  // a bit for each vertex, by the mesh's numbers; empty: none

  void begin(const FeaturedMesh& of, SurfaceKind kind, double sign_of_exits, double unit);
  ScaledMesh scaled() const { return {*mesh.mesh, *mesh.features, scale}; }
  EdgeVertices source_ends(int edge) const;
  /// The first corner of a facet; both by the caller's numbers.
  int source_corner(int source_facet) const;
  /// The sum of the directions of the exits that an edge's ends have.
  Vec3 exits_of(int edge) const;
  /// The direction that the crossing of a vertex keeps, unit, from a to b; zero if it keeps none. See
  /// kept_directions.h.
  Vec3 kept_by(int source_vertex) const;
};

/// What a vertex, by the caller's number, remembers of the last step: the normal of its point, from a to b.
struct CarriedNormal {
  int vertex = -1;
  Vec3 normal;
  double gap = 0.0;  // it had, metres
};

/// What two bodies remember of the last step.
struct CarriedPoints {
  std::span<const CarriedNormal> of_a, of_b;  // of vertices; sorted, each once
  std::span<const FeaturePoint> of_edges;     // points between two edges
};

class CrossingGroups;

/// Const calls may come from many threads.
struct Crossing {
  CrossedSurface surfaces[2];  // of one mesh with itself only the first
  bool of_itself = false;
  double within = 0.0;  // scaled; no exit is longer, nor the way between edges that have passed each other
  // Of two bodies:
  Vec3 direction;  // of the contact, unit, from a to b
  std::span<const FacetPair> facet_pairs;
  CarriedPoints carried;
  const CrossingGroups* groups = nullptr;  // null: nobody needed them yet
  // Of one mesh with itself:
  double reach = 0.0;          // scaled
  bool limit_reached = false;  // a vertex that is past the mesh has no exit: it is farther than `within`
  CrossingSides sides;  // of its edge hits; points of the last step that tell of a side allow ways longer than `within`

  const CrossedSurface& a() const { return surfaces[0]; }
  const CrossedSurface& b() const { return surfaces[of_itself ? 0 : 1]; }
  /// Of one mesh with itself: the side of `hit`, which is one of its hits.
  Vec3 side_of(const EdgeHit& hit) const { return sides.sides()[&hit - a().cut.hits().data()]; }
};

}  // namespace tact::narrowphase

// Signs of orient3d() that are never zero: as if one of two meshes, or every vertex of one mesh, were moved by less
// than any length. All signs are those of one such motion, so what is decided by them fits together: intersection
// curves are closed or end at a border, whatever lies in one plane or on one line.
#pragma once

#include <array>

#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

/// A vertex: where it is, and its number of the caller's.
struct NumberedPoint {
  Vec3 at;
  int number = -1;
};
using NumberedTriangle = std::array<NumberedPoint, 3>;

/// Two edges, or the sides of a triangle and a point, of two meshes a and b, or of one, which then have no common
/// vertex.
class PerturbedSigns {
 public:
  /// Of two meshes: b is moved along the axis to which `apart`, which leads from a to b, is nearest, by far less along
  /// the next one and by far less than that along the last: what only touches is apart.
  static PerturbedSigns of_two(Vec3 apart);
  /// Of one mesh: each vertex is moved, one of a lower number by far more (Edelsbrunner and Mücke, "Simulation of
  /// Simplicity", 1990).
  static PerturbedSigns of_one() { return {}; }

  bool is_of_one() const { return of_one_; }
  /// orient3d(t[0], t[1], t[2], p): 1 below the triangle, -1 above. `side` says whose the point is: 0 of a, 1 of b.
  /// Zero only if the triangle has no area, of two meshes.
  int side(const NumberedTriangle& t, const NumberedPoint& p, int whose);
  /// orient3d(p, q, r, s) of an edge of a and one of b. Zero only if they are parallel, of two meshes: then neither
  /// crosses a plane that holds the other.
  int edges(const NumberedPoint& p, const NumberedPoint& q, const NumberedPoint& r, const NumberedPoint& s);
  /// Of two meshes: the turn of an edge of one and a point of the other, seen against x: orient2d() of y and z. `whose`
  /// says whose the point is. Zero only if the edge is a point, seen so.
  int turn_along_x(Vec3 p, Vec3 q, Vec3 point, int whose);

 private:
  // The sign of ((q - p) × (s - r)) along the way that b is moved.
  int along_motion(Vec3 p, Vec3 q, Vec3 r, Vec3 s) const;
  int of_vertices(const std::array<NumberedPoint, 4>& points);

  bool of_one_ = true;
  std::array<int, 3> axis_{0, 1, 2}, way_{1, 1, 1};
  PredicateCounts counts_;
};

}  // namespace tact::narrowphase

// The face of M that a direction supports, seen along the direction: does it hold the foot of the origin, and which
// faces lie next to it?
#pragma once

#include <vector>

#include "narrowphase/hull/gjk.h"
#include "narrowphase/hull/minkowski_difference.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

// A convex polygon across a direction n: the face, projected on u and v, (u, v, n) orthonormal. The foot of the origin
// on the supporting plane is at (0, 0). Scaled.
struct FacePolygon {
  Vec3 u, v;
  std::vector<Point2> corner;  // counter-clockwise seen against n; 1: a vertex of M, 2: an edge
};

// The signed distance of the foot from the line of the side from corner `side` to the next, positive inside. An edge
// has two sides, on one line. There must be at least two corners.
double distance_from_side(const FacePolygon& polygon, std::size_t side);

// Across n and the side, away from the polygon; unit, or not numbers for a side without length.
Vec3 outward_of_side(const FacePolygon& polygon, std::size_t side);

Point2 corner_at(const std::vector<Point2>& polygon, std::size_t i);  // i may be beyond the last: it goes around
std::size_t nearest_corner(const FacePolygon& polygon, Point2 point);

// The distance of the foot from the border; negative outside. At most zero for an edge or a corner.
double margin_of_foot(const FacePolygon& polygon);

// Finds the polygons of faces; its memory is reused. A polygon is valid until the next call.
class FaceFinder {
 public:
  // What the vertices of A and of B in `simplex` span: all a - b. At least one of each.
  const FacePolygon& spanned(const MinkowskiDifference& m, const GjkSimplex& simplex, Vec3 n);
  // What all vertices of A and of B within `tolerance` (scaled) of their supporting planes across n span. `near`: see
  // MinkowskiDifference::support().
  const FacePolygon& supported(const MinkowskiDifference& m, Vec3 n, double tolerance, const MinkowskiVertex& near);
  // Three vertices of M in the face that was found last, likely a triangle well around the foot: what the next step
  // needs of the face. None for an edge or a vertex.
  GjkSimplex around_foot(const MinkowskiDifference& m) const;

 private:
  void collect(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, double tolerance, int near, std::vector<int>& found);
  void project(const MinkowskiDifference& m, Vec3 n);
  Point2 flat(const MinkowskiDifference& m, Vec3 position, Vec3 from, double sign) const;
  int vertex_at(const MinkowskiDifference& m, const ClusteredMesh& mesh, const std::vector<int>& vertices, double sign,
                Point2 point) const;

  FacePolygon polygon_;
  Point2 base_{};  // the vertex of M that the hulls are relative to
  std::vector<int> a_, b_;
  std::vector<Point2> points_a_, points_b_, hull_a_, hull_b_, sum_;
};

// Turns n about the axis through `p`, a point of M in the supporting plane of n, towards `t` (unit, across n and the
// axis) until the plane meets another vertex of M: the normal of that supporting plane. M must not reach beyond the
// plane of n by more than `tolerance`. Nothing is found within a right angle: t itself; t is not a direction: n.
// `near`: see MinkowskiDifference::support().
Vec3 turned_to_next_face(const MinkowskiDifference& m, Vec3 n, Vec3 p, Vec3 t, double tolerance,
                         const MinkowskiVertex& near);

}  // namespace tact::narrowphase

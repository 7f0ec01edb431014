// The face of M that a direction supports, seen along the direction; whether it holds the *projection*, that of the
// origin on the supporting plane; and the faces next to it.
#pragma once

#include <vector>

#include "narrowphase/hull/gjk.h"
#include "narrowphase/hull/minkowski_difference.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

// A convex polygon across a direction n: the face in coordinates u and v, (u, v, n) orthonormal, scaled. The projection
// is at (0, 0).
struct FacePolygon {
  Vec3 u, v;
  std::vector<Point2> corner;  // counter-clockwise seen against n; 1: a vertex of M, 2: an edge
};

// The signed distance of the projection from the line of the side from corner `side` to the next, positive inside. An
// edge has two sides, on one line. There must be at least two corners.
double distance_from_side(const FacePolygon& polygon, std::size_t side);

// Across n and the side, away from the polygon; unit, or not numbers for a side without length.
Vec3 outward_of_side(const FacePolygon& polygon, std::size_t side);

double length_of(Point2 v);
Point2 corner_at(const std::vector<Point2>& polygon, std::size_t i);  // i may be beyond the last: it goes around
std::size_t nearest_corner(const FacePolygon& polygon, Point2 point);

// The distance of the projection from the border; negative outside. At most zero for an edge or a corner.
double margin_of_projection(const FacePolygon& polygon);

// Finds the polygons of faces; its memory is reused. A polygon is valid until the next call.
class FaceFinder {
 public:
  // What the vertices of A and of B in `simplex` span: all a - b. At least one of each.
  const FacePolygon& spanned(const MinkowskiDifference& m, const GjkSimplex& simplex, Vec3 n);
  // What those vertices of A and of B span that lie within `tolerance` (scaled) of their supporting planes across n.
  // `near`: see MinkowskiDifference::support().
  const FacePolygon& supported(const MinkowskiDifference& m, Vec3 n, double tolerance, const MinkowskiVertex& near);
  // Three vertices of M in the face that was found last, for the next step: most likely a triangle with the projection
  // well inside. None for an edge or a vertex.
  GjkSimplex around_projection(const MinkowskiDifference& m) const;

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

// Turns the supporting plane of n about an axis through `p`, a point of M in it, towards `t` (unit, across n and the
// axis) until it meets another vertex of M. Returns the normal of the turned plane; t if no vertex is met within a
// right angle; n if t is not a direction. M must not reach beyond the plane of n by more than `tolerance`. `near`: see
// MinkowskiDifference::support().
Vec3 turned_to_next_face(const MinkowskiDifference& m, Vec3 n, Vec3 p, Vec3 t, double tolerance,
                         const MinkowskiVertex& near);

}  // namespace tact::narrowphase

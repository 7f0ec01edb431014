#include "narrowphase/direction/minkowski_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/numeric/double_double.h"
#include "narrowphase/numeric/frame.h"

namespace tact::narrowphase {

namespace {

constexpr int kTurnLimit = 1000;

// The corners of a triangle around the projection are chosen in three directions: by the distance along a direction,
// less this times the distance from its line.
constexpr double kAside = 0.5;

double cross2(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }
Point2 minus(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
bool before(Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

bool same(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }

// Of corners of a polygon that follow each other and are one point, leaves the first.
void drop_repeated(std::vector<Point2>& corners) {
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  while (corners.size() > 1 && same(corners.front(), corners.back())) corners.pop_back();
}

// The corners of the convex hull of `points`, counter-clockwise from the lowest x (Andrew, 1979). Sorts `points`.
void convex_hull(std::vector<Point2>& points, std::vector<Point2>& hull) {
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  hull.clear();
  const auto extend = [&](Point2 p, std::size_t least) {
    while (hull.size() > least && cross2(minus(hull.back(), hull[hull.size() - 2]), minus(p, hull.back())) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Point2 p : points) extend(p, 1);
  if (points.size() < 3) return;
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], lower);
  hull.pop_back();
}

// The sum of two convex polygons: their sides in the order of their angles. Both start at the lowest x.
void minkowski_sum(const std::vector<Point2>& p, const std::vector<Point2>& q, std::vector<Point2>& sum) {
  sum.clear();
  std::size_t i = 0, j = 0;
  const std::size_t sides_p = p.size() > 1 ? p.size() : 0, sides_q = q.size() > 1 ? q.size() : 0;
  while (i < sides_p || j < sides_q) {
    sum.push_back({corner_at(p, i).x + corner_at(q, j).x, corner_at(p, i).y + corner_at(q, j).y});
    if (i == sides_p) {
      ++j;
    } else if (j == sides_q) {
      ++i;
    } else {
      const Point2 e = minus(corner_at(p, i + 1), corner_at(p, i)), f = minus(corner_at(q, j + 1), corner_at(q, j));
      const bool upper_e = before(e, {0.0, 0.0}), upper_f = before(f, {0.0, 0.0});  // the second half of the turn
      const double turn = upper_e != upper_f ? (upper_f ? 1.0 : -1.0) : cross2(e, f);
      if (turn >= 0.0) ++i;
      if (turn <= 0.0) ++j;
    }
  }
  if (sum.empty()) sum.push_back({p[0].x + q[0].x, p[0].y + q[0].y});
}

}  // namespace

Point2 corner_at(const std::vector<Point2>& polygon, std::size_t i) { return polygon[i % polygon.size()]; }

const FacePolygon& FaceFinder::spanned(const MinkowskiDifference& m, const GjkSimplex& simplex, Vec3 n) {
  a_.assign(simplex.a.begin(), simplex.a.begin() + simplex.count);
  b_.assign(simplex.b.begin(), simplex.b.begin() + simplex.count);
  project(m, n);
  return polygon_;
}

const FacePolygon& FaceFinder::supported(const MinkowskiDifference& m, Vec3 n, double tolerance,
                                         const MinkowskiVertex& near) {
  collect(m.a(), n, m.origin(), tolerance / m.scale(), near.a, a_);
  collect(m.b(), -n, m.origin(), tolerance / m.scale(), near.b, b_);
  project(m, n);
  return polygon_;
}

GjkSimplex FaceFinder::around_projection(const MinkowskiDifference& m) const {
  if (polygon_.corner.size() < 3) return {};
  constexpr std::size_t kMost = 8;
  const std::size_t count_a = std::min(hull_a_.size(), kMost), count_b = std::min(hull_b_.size(), kMost);
  const auto place_a = [&](std::size_t i) { return i * hull_a_.size() / count_a; };
  const auto place_b = [&](std::size_t j) { return j * hull_b_.size() / count_b; };
  GjkSimplex simplex;
  for (const Point2 toward : kThirds) {
    double best = -std::numeric_limits<double>::infinity();
    std::size_t best_a = 0, best_b = 0;
    for (std::size_t i = 0; i < count_a; ++i) {
      for (std::size_t j = 0; j < count_b; ++j) {
        const Point2 a = hull_a_[place_a(i)], b = hull_b_[place_b(j)];
        const Point2 p{base_.x + a.x + b.x, base_.y + a.y + b.y};
        const double reach = toward.x * p.x + toward.y * p.y - kAside * std::abs(cross2(toward, p));
        if (!(reach > best)) continue;
        best = reach;
        best_a = place_a(i);
        best_b = place_b(j);
      }
    }
    simplex.a[simplex.count] = vertex_at(m, m.a(), a_, 1.0, hull_a_[best_a]);
    simplex.b[simplex.count] = vertex_at(m, m.b(), b_, -1.0, hull_b_[best_b]);
    ++simplex.count;
  }
  return simplex;
}

// Of the vertices of a face that were projected to `point`, the one with the lowest source vertex.
int FaceFinder::vertex_at(const MinkowskiDifference& m, const ClusteredMesh& mesh, const std::vector<int>& vertices,
                          double sign, Point2 point) const {
  const Vec3 from = mesh.position(vertices.front());
  int first = -1;
  for (const int v : vertices)
    if ((first < 0 || mesh.source_vertex(v) < mesh.source_vertex(first)) &&
        same(flat(m, mesh.position(v), from, sign), point))
      first = v;
  return first < 0 ? vertices.front() : first;
}

// The difference of two positions, or its opposite, on the plane of the polygon; scaled.
Point2 FaceFinder::flat(const MinkowskiDifference& m, Vec3 position, Vec3 from, double sign) const {
  const Vec3 d = m.scale() * (sign * (position - from));
  return {dot(polygon_.u, d), dot(polygon_.v, d)};
}

// The vertices of `mesh` within `tolerance` (metres) of the farthest along n. The first is the one with the lowest
// source vertex: the others are projected relative to it, and no rounding may depend on how facets are grouped.
void FaceFinder::collect(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, double tolerance, int near,
                         std::vector<int>& found) {
  select_vertices(mesh, n, origin, support(mesh, n, origin, near).height - tolerance, found);
  const auto source = [&](int v) { return mesh.source_vertex(v); };
  std::iter_swap(found.begin(), std::ranges::min_element(found, {}, source));
}

// Positions are taken relative to one vertex of each body, so that only differences are rounded.
void FaceFinder::project(const MinkowskiDifference& m, Vec3 n) {
  const Frame frame = frame_across(n);
  polygon_.u = frame.u;
  polygon_.v = frame.v;
  const Vec3 a0 = m.a().position(a_[0]), b0 = m.b().position(b_[0]);
  points_a_.clear();
  points_b_.clear();
  for (const int a : a_) points_a_.push_back(flat(m, m.a().position(a), a0, 1.0));
  for (const int b : b_) points_b_.push_back(flat(m, m.b().position(b), b0, -1.0));
  convex_hull(points_a_, hull_a_);
  convex_hull(points_b_, hull_b_);
  minkowski_sum(hull_a_, hull_b_, sum_);
  convex_hull(sum_, polygon_.corner);  // drops corners that rounding made straight or inward
  const Vec3 base = m.vertex(a_[0], b_[0]).point;
  base_ = {dot(frame.u, base), dot(frame.v, base)};
  for (Point2& c : polygon_.corner) c = {c.x + base_.x, c.y + base_.y};
  drop_repeated(polygon_.corner);  // what lies within a rounding of the base: between them is no side
}

double length_of(Point2 v) { return length_of(Vec3{v.x, v.y, 0.0}); }

double distance_from_side(const FacePolygon& polygon, std::size_t side) {
  const Point2 from = polygon.corner[side], along = minus(corner_at(polygon.corner, side + 1), from);
  return cross2(along, {-from.x, -from.y}) / length_of(along);
}

Vec3 outward_of_side(const FacePolygon& polygon, std::size_t side) {
  const Point2 along = minus(corner_at(polygon.corner, side + 1), polygon.corner[side]);
  return normalized(along.y * polygon.u - along.x * polygon.v);
}

std::size_t nearest_corner(const FacePolygon& polygon, Point2 point) {
  const auto distance = [&](Point2 c) { return length_of(minus(c, point)); };
  return static_cast<std::size_t>(std::ranges::min_element(polygon.corner, {}, distance) - polygon.corner.begin());
}

double margin_of_projection(const FacePolygon& polygon) {
  const std::vector<Point2>& c = polygon.corner;
  if (c.size() == 1) return -length_of(c[0]);
  double margin = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < c.size(); ++i) margin = std::min(margin, distance_from_side(polygon, i));
  if (c.size() == 2) {  // the projection may lie in the line of an edge, but beyond its ends
    const Point2 side = minus(c[1], c[0]);
    const double length = length_of(side), along = -(c[0].x * side.x + c[0].y * side.y) / length;
    margin = std::min({margin, along, length - along});
  }
  return margin;
}

Vec3 turned_to_next_face(const MinkowskiDifference& m, Vec3 n, Vec3 p, Vec3 t, double tolerance,
                         const MinkowskiVertex& near) {
  if (!(norm_squared(t) > 0.0)) return n;  // not a direction
  Vec3 turned = t;
  MinkowskiVertex top = near;
  for (int i = 0; i < kTurnLimit; ++i) {
    top = m.support(turned, top);
    const Vec3 d = top.point - p;
    if (dot(turned, d) <= tolerance) break;
    const double along = dot(t, d), below = std::max(0.0, -dot(n, d));
    if (along <= tolerance) break;
    const Vec3 next = normalized(along * n + below * t);
    if (next == turned || !(norm_squared(next) > 0.0)) break;
    turned = next;
  }
  return turned;
}

}  // namespace tact::narrowphase

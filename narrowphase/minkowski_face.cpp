#include "narrowphase/minkowski_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/frame.h"

namespace tact::narrowphase {

namespace {

constexpr int kTurnLimit = 1000;

double cross2(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }
Point2 minus(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
bool before(Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

// The corners of the convex hull of `points`, counter-clockwise from the lowest x (Andrew, 1979). Sorts `points`.
void convex_hull(std::vector<Point2>& points, std::vector<Point2>& hull) {
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end(), [](Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }),
               points.end());
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

// The vertices of `mesh` within `tolerance` (metres) of the farthest along n.
void FaceFinder::collect(const ClusteredMesh& mesh, Vec3 n, Vec3 origin, double tolerance, int near,
                         std::vector<int>& found) {
  const HeightAxis axis{n.x, n.y, n.z, origin.x, origin.y, origin.z};
  const double height = support(mesh, n, origin, near).height - tolerance;
  select_clusters(mesh, axis, height, clusters_);
  found.clear();
  for (const std::int32_t cluster : clusters_) {
    const int begin = mesh.vertex_begin(cluster), count = mesh.vertex_end(cluster) - begin;
    inside_.resize(static_cast<std::size_t>(count));
    const PointArrays p = mesh.points();
    const int kept =
        kernels().select_heights({p.x + begin, p.y + begin, p.z + begin}, count, axis, height, inside_.data());
    for (int k = 0; k < kept; ++k) found.push_back(begin + inside_[static_cast<std::size_t>(k)]);
  }
}

// Positions are taken relative to one vertex of each body, so that only differences are rounded.
void FaceFinder::project(const MinkowskiDifference& m, Vec3 n) {
  const Frame frame = frame_across(n);
  const auto flat = [&](Vec3 d) { return Point2{dot(frame.u, d), dot(frame.v, d)}; };
  const Vec3 a0 = m.a().position(a_[0]), b0 = m.b().position(b_[0]);
  points_a_.clear();
  points_b_.clear();
  for (const int a : a_) points_a_.push_back(flat(m.scale() * (m.a().position(a) - a0)));
  for (const int b : b_) points_b_.push_back(flat(m.scale() * (b0 - m.b().position(b))));
  convex_hull(points_a_, hull_a_);
  convex_hull(points_b_, hull_b_);
  minkowski_sum(hull_a_, hull_b_, sum_);
  polygon_.u = frame.u;
  polygon_.v = frame.v;
  convex_hull(sum_, polygon_.corner);  // drops corners that rounding made straight or inward
  const Point2 base = flat(m.vertex(a_[0], b_[0]).point);
  for (Point2& c : polygon_.corner) c = {c.x + base.x, c.y + base.y};
}

double distance_from_side(const FacePolygon& polygon, std::size_t side) {
  const Point2 from = polygon.corner[side], along = minus(corner_at(polygon.corner, side + 1), from);
  return cross2(along, {-from.x, -from.y}) / std::hypot(along.x, along.y);
}

Vec3 outward_of_side(const FacePolygon& polygon, std::size_t side) {
  const Point2 along = minus(corner_at(polygon.corner, side + 1), polygon.corner[side]);
  return normalized(along.y * polygon.u - along.x * polygon.v);
}

std::size_t nearest_corner(const FacePolygon& polygon, Point2 point) {
  const auto distance = [&](Point2 c) { return std::hypot(c.x - point.x, c.y - point.y); };
  return static_cast<std::size_t>(std::ranges::min_element(polygon.corner, {}, distance) - polygon.corner.begin());
}

double margin_of_foot(const FacePolygon& polygon) {
  const std::vector<Point2>& c = polygon.corner;
  if (c.size() == 1) return -std::hypot(c[0].x, c[0].y);
  double margin = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < c.size(); ++i) margin = std::min(margin, distance_from_side(polygon, i));
  if (c.size() == 2) {  // the foot may lie in the line of an edge, but beyond its ends
    const Point2 side = minus(c[1], c[0]);
    const double length = std::hypot(side.x, side.y), along = -(c[0].x * side.x + c[0].y * side.y) / length;
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

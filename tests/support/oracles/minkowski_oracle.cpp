#include "tests/support/oracles/minkowski_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numbers>

namespace tact::tests {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Long3 widened(Vec3 p) { return {p.x, p.y, p.z}; }
Long3 operator-(Long3 p, Long3 q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
long double dot(Long3 p, Long3 q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
long double norm(Long3 p) { return std::sqrt(dot(p, p)); }
Long3 divided(Long3 p, long double s) { return {p.x / s, p.y / s, p.z / s}; }

// p × q for differences of doubles. Where p and q are nearly parallel the products are taken in 113 bits, which hold
// them exactly: the direction stays right however slender a facet is.
Long3 cross(Long3 p, Long3 q) {
  const Long3 n{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  if (norm(n) > 1e-4L * norm(p) * norm(q)) return n;
#if LDBL_MANT_DIG == 113
  using Quad = long double;
#else
  __extension__ using Quad = __float128;
#endif
  const auto minor = [](long double s, long double t, long double u, long double v) {
    return static_cast<long double>(static_cast<Quad>(s) * t - static_cast<Quad>(u) * v);
  };
  return {minor(p.y, q.z, p.z, q.y), minor(p.z, q.x, p.x, q.z), minor(p.x, q.y, p.y, q.x)};
}

std::vector<Long3> widened(std::span<const Vec3> points) {
  std::vector<Long3> wide;
  for (const Vec3& p : points) wide.push_back(widened(p));
  return wide;
}

// The least and the largest n · p.
struct Range {
  long double low;
  long double high;
};

Range range_along(const std::vector<Long3>& points, Long3 n) {
  Range range{dot(n, points[0]), dot(n, points[0])};
  for (const Long3& p : points) {
    const long double height = dot(n, p);
    range.low = std::min(range.low, height);
    range.high = std::max(range.high, height);
  }
  return range;
}

// Edges and facet normals of a hull, or more than those. Neither is of unit length.
struct HullFeatures {
  std::vector<Long3> edges;
  std::vector<Long3> normals;
};

HullFeatures features_of_all_points(const std::vector<Long3>& points) {
  HullFeatures features;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      features.edges.push_back(points[i] - points[j]);
      for (std::size_t k = 0; k < j; ++k) {
        features.normals.push_back(cross(points[i] - points[k], points[j] - points[k]));
      }
    }
  }
  return features;
}

HullFeatures features(std::span<const Vec3> points) {
  constexpr std::size_t kTryAll = 8;
  const std::vector<Long3> wide = widened(points);
  if (points.size() <= kTryAll) return features_of_all_points(wide);
  std::vector<Kernel::Point_3> cgal_points;
  for (const Vec3& p : points) cgal_points.emplace_back(p.x, p.y, p.z);
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(cgal_points.begin(), cgal_points.end(), hull);
  if (hull.number_of_faces() < 4) return features_of_all_points(wide);
  const auto point = [&](auto vertex) {
    const Kernel::Point_3& p = hull.point(vertex);
    return Long3{p.x(), p.y(), p.z()};
  };
  HullFeatures result;
  for (const auto edge : hull.edges()) {
    result.edges.push_back(point(hull.vertex(edge, 1)) - point(hull.vertex(edge, 0)));
  }
  for (const auto face : hull.faces()) {
    const auto h = hull.halfedge(face);
    const Long3 p = point(hull.source(h));
    result.normals.push_back(cross(point(hull.target(h)) - p, point(hull.target(hull.next(h))) - p));
  }
  return result;
}

// Two unit vectors that complete n to an orthogonal frame.
std::array<Long3, 2> frame(Long3 n) {
  const Long3 axis = std::abs(n.x) < 0.6L ? Long3{1, 0, 0} : Long3{0, 1, 0};
  Long3 u = cross(n, axis);
  u = divided(u, norm(u));
  return {u, cross(n, u)};
}

// All directions that may be a face normal of the difference, one of each opposite pair.
std::vector<Long3> candidate_normals(const HullFeatures& a, const HullFeatures& b) {
  std::vector<Long3> candidates;
  const auto add = [&](Long3 n) {
    const long double length = norm(n);
    if (length > 0.0L) candidates.push_back(divided(n, length));
  };
  for (const Long3& n : a.normals) add(n);
  for (const Long3& n : b.normals) add(n);
  for (const Long3& e : a.edges) {
    for (const Long3& f : b.edges) add(cross(e, f));
  }
  // A straight difference has no face; any direction across it will do.
  if (candidates.empty()) {
    Long3 along{0, 0, 1};
    for (const HullFeatures* part : {&a, &b}) {
      for (const Long3& e : part->edges) {
        if (norm(e) > 0.0L) along = divided(e, norm(e));
      }
    }
    candidates.push_back(frame(along)[0]);
  }
  return candidates;
}

bool is_new(const std::vector<Vec3>& directions, Vec3 n) {
  return std::none_of(directions.begin(), directions.end(), [&](Vec3 m) { return base::norm(m - n) < 1e-6; });
}

}  // namespace

MinkowskiHeight::MinkowskiHeight(std::span<const Vec3> a, std::span<const Vec3> b) : a_(widened(a)), b_(widened(b)) {
  const Long3 origin = a_[0];
  for (std::vector<Long3>* points : {&a_, &b_}) {
    for (Long3& p : *points) p = p - origin;
  }
}

long double MinkowskiHeight::along(const Long3& n, const Long3& shift) const {
  return (range_along(a_, n).high - range_along(b_, n).low - dot(n, shift)) / norm(n);
}

long double MinkowskiHeight::operator()(Vec3 n, Vec3 shift) const { return along(widened(n), widened(shift)); }

double MinkowskiHeight::size() const {
  long double largest = 0.0L;
  for (const Long3& axis : {Long3{1, 0, 0}, Long3{0, 1, 0}, Long3{0, 0, 1}}) {
    const Range a = range_along(a_, axis), b = range_along(b_, axis);
    largest = std::max(largest, std::max(a.high, b.high) - std::min(a.low, b.low));
  }
  return static_cast<double>(largest);
}

bool MinkowskiHeight::is_local_minimum(Vec3 n, double tolerance, Vec3 shift) const {
  constexpr int kTurns = 64;
  const Long3 center = divided(widened(n), norm(widened(n))), by = widened(shift);
  const auto [u, v] = frame(center);
  const long double allowed = along(center, by) - static_cast<long double>(tolerance);
  long double radius = 1e-2L;
  for (int decade = 2; decade <= 7; ++decade, radius *= 0.1L) {
    for (int turn = 0; turn < kTurns; ++turn) {
      const long double angle = 2.0L * std::numbers::pi_v<long double> * turn / kTurns;
      const long double s = radius * std::cos(angle), t = radius * std::sin(angle);
      const Long3 turned{center.x + s * u.x + t * v.x, center.y + s * u.y + t * v.y, center.z + s * u.z + t * v.z};
      if (along(turned, by) < allowed) return false;
    }
  }
  return true;
}

long double minkowski_height(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 n) {
  return MinkowskiHeight(a, b)(n);
}

bool is_local_minimum(std::span<const Vec3> a, std::span<const Vec3> b, Vec3 n, double tolerance) {
  return MinkowskiHeight(a, b).is_local_minimum(n, tolerance);
}

SmallestHeight smallest_height(std::span<const Vec3> a, std::span<const Vec3> b, double tie_tolerance) {
  const std::vector<Long3> points_a = widened(a);
  const std::vector<Long3> points_b = widened(b);
  struct Candidate {
    Long3 n;
    long double height;
  };
  std::vector<Candidate> candidates;
  for (const Long3& n : candidate_normals(features(a), features(b))) {
    const Range range_a = range_along(points_a, n);
    const Range range_b = range_along(points_b, n);
    candidates.push_back({n, range_a.high - range_b.low});
    candidates.push_back({{-n.x, -n.y, -n.z}, range_b.high - range_a.low});
  }
  const auto lower = [](const Candidate& p, const Candidate& q) { return p.height < q.height; };
  SmallestHeight result;
  result.height = std::min_element(candidates.begin(), candidates.end(), lower)->height;
  for (const Candidate& c : candidates) {
    if (c.height > result.height + static_cast<long double>(tie_tolerance)) continue;
    const Vec3 n{static_cast<double>(c.n.x), static_cast<double>(c.n.y), static_cast<double>(c.n.z)};
    if (is_new(result.directions, n)) result.directions.push_back(n);
  }
  return result;
}

}  // namespace tact::tests

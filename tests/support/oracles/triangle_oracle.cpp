#include "tests/support/oracles/triangle_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

namespace tact::tests {
namespace {

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
using Rational = CGAL::Exact_rational;
using Exact = CGAL::Simple_cartesian<Rational>;

Exact::Point_3 exact(const Vec3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
Filtered::Point_3 filtered(const Vec3& p) { return {p.x, p.y, p.z}; }

bool has_area(const Triangle& t) { return !CGAL::collinear(filtered(t[0]), filtered(t[1]), filtered(t[2])); }

using Figure = std::variant<Exact::Point_3, Exact::Segment_3, Exact::Triangle_3>;

Figure figure(const Triangle& t) {
  const Exact::Point_3 p = exact(t[0]);
  const Exact::Point_3 q = exact(t[1]);
  const Exact::Point_3 r = exact(t[2]);
  if (!CGAL::collinear(p, q, r)) return Exact::Triangle_3(p, q, r);
  const auto [low, high] = std::minmax({p, q, r});
  if (low == high) return low;
  return Exact::Segment_3(low, high);
}

}  // namespace

int rational_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Rational px = Rational(a.x) - Rational(d.x), py = Rational(a.y) - Rational(d.y),
                 pz = Rational(a.z) - Rational(d.z);
  const Rational qx = Rational(b.x) - Rational(d.x), qy = Rational(b.y) - Rational(d.y),
                 qz = Rational(b.z) - Rational(d.z);
  const Rational rx = Rational(c.x) - Rational(d.x), ry = Rational(c.y) - Rational(d.y),
                 rz = Rational(c.z) - Rational(d.z);
  const Rational determinant = px * (qy * rz - qz * ry) + py * (qz * rx - qx * rz) + pz * (qx * ry - qy * rx);
  return static_cast<int>(CGAL::sign(determinant));
}

int rational_orient2d(const Point2& a, const Point2& b, const Point2& c) {
  const Rational determinant = (Rational(a.x) - Rational(c.x)) * (Rational(b.y) - Rational(c.y)) -
                               (Rational(a.y) - Rational(c.y)) * (Rational(b.x) - Rational(c.x));
  return static_cast<int>(CGAL::sign(determinant));
}

bool cgal_meet(const Triangle& a, const Triangle& b) {
  if (has_area(a) && has_area(b)) {
    return CGAL::do_intersect(Filtered::Triangle_3(filtered(a[0]), filtered(a[1]), filtered(a[2])),
                              Filtered::Triangle_3(filtered(b[0]), filtered(b[1]), filtered(b[2])));
  }
  return rational_meet(a, b);
}

bool rational_meet(const Triangle& a, const Triangle& b) {
  return std::visit([](const auto& p, const auto& q) { return CGAL::do_intersect(p, q); }, figure(a), figure(b));
}

bool is_nearest_to_distance(double distance, const Vec3& point, const Triangle& t) {
  const Rational square =
      std::visit([&](const auto& of) -> Rational { return CGAL::squared_distance(exact(point), of); }, figure(t));
  const auto middle_squared = [&](double neighbor) {
    const Rational sum = Rational(distance) + Rational(neighbor);
    return Rational(sum * sum / Rational(4));
  };
  const double next = std::nextafter(distance, std::numeric_limits<double>::infinity());
  return square <= middle_squared(next) && (distance == 0.0 || square >= middle_squared(std::nextafter(distance, 0.0)));
}

bool is_nearest_to_time(double time, const Vec3& from, const Vec3& to, const Triangle& t) {
  const Exact::Vector_3 normal = CGAL::cross_product(exact(t[1]) - exact(t[0]), exact(t[2]) - exact(t[0]));
  const Rational part = (normal * (exact(t[0]) - exact(from))) / (normal * (exact(to) - exact(from)));
  const auto middle = [&](double neighbor) { return Rational((Rational(time) + Rational(neighbor)) / Rational(2)); };
  return part <= middle(std::nextafter(time, 2.0)) && part >= middle(std::nextafter(time, -1.0));
}

namespace {

using Points = std::vector<Exact::Point_3>;

Points corners_of(const Exact::Point_3& p) { return {p}; }
Points corners_of(const Exact::Segment_3& s) { return {s.source(), s.target()}; }
Points corners_of(const Exact::Triangle_3& t) { return {t[0], t[1], t[2]}; }
Points corners_of(const Points& points) { return points; }

// The corners of what two figures have in common.
Points intersection_of(const Exact::Point_3& p, const Exact::Point_3& q) { return p == q ? Points{p} : Points{}; }
template <class Other>
Points intersection_of(const Exact::Point_3& p, const Other& other) {
  return other.has_on(p) ? Points{p} : Points{};
}
template <class One>
Points intersection_of(const One& one, const Exact::Point_3& p) {
  return intersection_of(p, one);
}
template <class One, class Other>
Points intersection_of(const One& one, const Other& other) {
  const auto common = CGAL::intersection(one, other);
  if (!common) return {};
  return boost::apply_visitor([](const auto& figure) { return corners_of(figure); }, *common);
}

}  // namespace

bool rational_meet_beyond(const Triangle& a, const Triangle& b, int common) {
  if (common == 3) return has_area(a);
  const Points corners =
      std::visit([](const auto& p, const auto& q) { return intersection_of(p, q); }, figure(a), figure(b));
  const Exact::Point_3 p = exact(a[0]), q = common == 2 ? exact(a[1]) : p;
  const auto is_common = [&](const Exact::Point_3& one) {
    return p == q ? one == p : Exact::Segment_3(p, q).has_on(one);
  };
  return !std::ranges::all_of(corners, is_common);
}

}  // namespace tact::tests

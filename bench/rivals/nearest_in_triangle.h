// What Embree's point queries leave to the caller: the nearest point of a triangle.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace tact::bench {

/// On the triangle's plane where that is inside, else on its nearest side.
template <class Real>
Eigen::Vector3<Real> nearest_in_triangle(const Eigen::Vector3<Real>& p, const Eigen::Vector3<Real>& a,
                                         const Eigen::Vector3<Real>& b, const Eigen::Vector3<Real>& c) {
  using Point = Eigen::Vector3<Real>;
  const Point u = b - a, v = c - a, w = p - a;
  const Real uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const Real area = uu * vv - uv * uv, s = vv * uw - uv * vw, t = uu * vw - uv * uw;
  if (s >= 0 && t >= 0 && s + t <= area && area > 0) return a + (s * u + t * v) / area;
  const auto on_side = [&](const Point& from, const Point& to) -> Point {
    const Point way = to - from;
    const Real length2 = way.squaredNorm();
    return from + (length2 > 0 ? std::clamp(way.dot(p - from) / length2, Real{0}, Real{1}) : Real{0}) * way;
  };
  Point nearest = on_side(a, b);
  for (const Point& other : {on_side(b, c), on_side(c, a)}) {
    if ((other - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = other;
  }
  return nearest;
}

}  // namespace tact::bench

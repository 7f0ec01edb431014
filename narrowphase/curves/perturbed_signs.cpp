#include "narrowphase/curves/perturbed_signs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "narrowphase/numeric/wide_vector.h"

namespace tact::narrowphase {

namespace {

Point2 in_plane(const Vec3& p, int u, int v) { return {p[u], p[v]}; }

// The determinant of rows (u, v, 1) of three points, or its sign.
int minor_of_three(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v, PredicateCounts& counts) {
  return orient2d(in_plane(a, u, v), in_plane(b, u, v), in_plane(c, u, v), counts);
}

int minor_of_two(const Vec3& a, const Vec3& b, int u) { return a[u] > b[u] ? 1 : a[u] < b[u] ? -1 : 0; }

// The coefficients of the motions in the determinant of four points, from the largest motion on: each vertex is moved
// along z by far more than along y, and along y by far more than along x. What stands for a motion is the determinant
// without its row and column, with the sign of its place; those that are equal to an earlier one are left out.
int sign_of_motions(const Vec3& i, const Vec3& j, const Vec3& k, const Vec3& l, PredicateCounts& counts) {
  constexpr int x = 0, y = 1, z = 2;
  int sign = 0;
  const auto decides = [&](int one) { return (sign = one) != 0; };
  if (decides(minor_of_three(j, k, l, x, y, counts))) return sign;
  if (decides(-minor_of_three(j, k, l, x, z, counts))) return sign;
  if (decides(minor_of_three(j, k, l, y, z, counts))) return sign;
  if (decides(-minor_of_three(i, k, l, x, y, counts))) return sign;
  if (decides(minor_of_two(k, l, x))) return sign;
  if (decides(-minor_of_two(k, l, y))) return sign;
  if (decides(minor_of_three(i, k, l, x, z, counts))) return sign;
  if (decides(minor_of_two(k, l, z))) return sign;
  if (decides(-minor_of_three(i, k, l, y, z, counts))) return sign;
  if (decides(minor_of_three(i, j, l, x, y, counts))) return sign;
  if (decides(-minor_of_two(j, l, x))) return sign;
  if (decides(minor_of_two(j, l, y))) return sign;
  if (decides(minor_of_two(i, l, x))) return sign;
  return 1;
}

}  // namespace

PerturbedSigns PerturbedSigns::of_two(Vec3 apart) {
  PerturbedSigns signs;
  signs.of_one_ = false;
  std::ranges::stable_sort(signs.axis_, [&](int u, int v) { return std::abs(apart[u]) > std::abs(apart[v]); });
  for (std::size_t i = 0; i < 3; ++i) signs.way_[i] = apart[signs.axis_[i]] < 0.0 ? -1 : 1;
  return signs;
}

int PerturbedSigns::along_motion(Vec3 p, Vec3 q, Vec3 r, Vec3 s) const {
  const int unit = std::min({lowest_bit(p), lowest_bit(q), lowest_bit(r), lowest_bit(s)});
  const auto way = [&](const Vec3& from, const Vec3& to) { return in_units<33>(to, unit) - in_units<33>(from, unit); };
  const auto normal = cross(way(p, q), way(r, s));
  const std::array<int, 3> sign{normal.x.sign(), normal.y.sign(), normal.z.sign()};
  for (std::size_t i = 0; i < 3; ++i) {
    if (const int one = sign[static_cast<std::size_t>(axis_[i])]; one != 0) return way_[i] * one;
  }
  return 0;
}

int PerturbedSigns::side(const NumberedTriangle& t, const NumberedPoint& p, int whose) {
  if (of_one_) return of_vertices({t[0], t[1], t[2], p});
  const int exact = orient3d(t[0].at, t[1].at, t[2].at, p.at, counts_);
  if (exact != 0) return exact;
  const int up = along_motion(t[0].at, t[1].at, t[0].at, t[2].at);  // the normal along the motion of b
  return whose == 1 ? -up : up;
}

int PerturbedSigns::edges(const NumberedPoint& p, const NumberedPoint& q, const NumberedPoint& r,
                          const NumberedPoint& s) {
  if (of_one_) return of_vertices({p, q, r, s});
  const int exact = orient3d(p.at, q.at, r.at, s.at, counts_);
  return exact != 0 ? exact : along_motion(p.at, q.at, r.at, s.at);
}

// The derivatives of (p - point) × (q - point) along the motion of the point against the edge.
int PerturbedSigns::turn_along_x(Vec3 p, Vec3 q, Vec3 point, int whose) {
  const int exact = orient2d(in_plane(p, 1, 2), in_plane(q, 1, 2), in_plane(point, 1, 2), counts_);
  if (exact != 0) return exact;
  for (std::size_t i = 0; i < 3; ++i) {
    const int of_axis = axis_[i] == 1 ? minor_of_two(p, q, 2) : axis_[i] == 2 ? minor_of_two(q, p, 1) : 0;
    if (of_axis != 0) return whose == 1 ? way_[i] * of_axis : -way_[i] * of_axis;
  }
  return 0;
}

int PerturbedSigns::of_vertices(const std::array<NumberedPoint, 4>& points) {
  const int exact = orient3d(points[0].at, points[1].at, points[2].at, points[3].at, counts_);
  if (exact != 0) return exact;
  std::array<NumberedPoint, 4> sorted = points;
  int parity = 1;
  for (std::size_t end = 3; end > 0; --end) {
    for (std::size_t i = 0; i < end; ++i) {
      if (sorted[i + 1].number < sorted[i].number) std::swap(sorted[i], sorted[i + 1]), parity = -parity;
    }
  }
  return parity * sign_of_motions(sorted[0].at, sorted[1].at, sorted[2].at, sorted[3].at, counts_);
}

}  // namespace tact::narrowphase

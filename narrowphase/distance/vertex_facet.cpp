#include "narrowphase/distance/vertex_facet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "narrowphase/distance/short_ways.h"
#include "narrowphase/distance/signs.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

std::optional<Nearest> nearest_inside_facet(Vec3 v, const Vec3 (&corner)[3], double limit) {
  const Vec3 normal = moderate_cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double square = norm_squared(normal), along = dot(normal, v - corner[0]);
  // Most vertices are too far, or beside the facet: that needs no root.
  if (square == 0.0 || along * along > limit * limit * square * (1.0 + 0x1p-40)) return {};
  // So are a facet's own vertices, of a body with itself: beyond doubt, where the signs would be computed finely.
  if (along == 0.0 && (v == corner[0] || v == corner[1] || v == corner[2])) return {};
  for (int k = 0; k < 3; ++k) {
    if (side_of_edge(v, corner[(k + 1) % 3], corner[(k + 2) % 3], corner[k]) <= 0) return {};
  }
  const double length = std::sqrt(square), height = height_above(v, {corner[0], corner[1], corner[2]}, normal, length);
  if (!(std::abs(height) < limit)) return {};
  Nearest nearest{.normal = (height < 0.0 ? 1.0 / length : -1.0 / length) * normal, .distance = std::abs(height)};
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = corner[(k + 1) % 3], q = corner[(k + 2) % 3];
    nearest.weight[k] = std::max(0.0, dot(normal, cross(q - p, v - p)));
    sum += nearest.weight[k];
  }
  if (!(sum > kVanishing)) {
    std::ranges::copy(weights_about(v, {corner[0], corner[1], corner[2]}), nearest.weight);
    return nearest;
  }
  for (double& weight : nearest.weight) weight /= sum;
  return nearest;
}

namespace {

Vec3 normal_of(const Triangle& t) {
  return double_double_cross(double_double_difference(t[1], t[0]), double_double_difference(t[2], t[0]));
}

// First how far the point is from the longest side, of which the corner c is the farthest, then along that side: what
// is rounded moves the place by roundings of the distance, however narrow the triangle is. Areas beside each side, one
// by one, would move it by so many times that as the triangle is longer than wide.
std::array<double, 3> nearest_weights(Vec3 p, const Triangle& t, Vec3 normal) {
  const double area2 = norm_squared(normal);
  if (!(area2 > 0.0)) return nearest_weights_on_sides(p, t);
  std::size_t c = 0;
  double length2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double one = norm_squared(t[(i + 2) % 3] - t[(i + 1) % 3]);
    if (one > length2) length2 = one, c = i;
  }
  const std::size_t a = (c + 1) % 3, b = (c + 2) % 3;
  const Vec3 side = t[b] - t[a], from_a = p - t[a];
  std::array<double, 3> w;
  w[c] = dot(from_a, cross(normal, side)) / area2;
  w[b] = (dot(from_a, side) - w[c] * dot(t[c] - t[a], side)) / length2;
  w[a] = 1.0 - w[b] - w[c];
  // By a side, and at a corner above all, the place on the sides may be the nearer one, and exact.
  const double least = std::min({w[0], w[1], w[2]});
  if (least > 0x1p-30) return w;
  const std::array<double, 3> beside = nearest_weights_on_sides(p, t);
  const bool takes_sides = least < 0.0 || norm_squared(place_of(t, beside) - p) <= norm_squared(place_of(t, w) - p);
  return takes_sides ? beside : w;
}

}  // namespace

std::array<double, 3> nearest_weights(Vec3 p, const Triangle& t) { return nearest_weights(p, t, normal_of(t)); }

std::array<double, 3> nearest_weights_on_sides(Vec3 p, const Triangle& t) {
  std::array<double, 3> best{1.0, 0.0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    const Vec3 side = t[k] - t[i];
    const double length2 = norm_squared(side);
    const double s = length2 > 0.0 ? std::clamp(dot(p - t[i], side) / length2, 0.0, 1.0) : 0.0;
    const double distance2 = norm_squared(t[i] + s * side - p);
    if (distance2 >= least) continue;
    least = distance2;
    best = {0.0, 0.0, 0.0};
    best[i] = 1.0 - s;
    best[k] += s;
  }
  return best;
}

std::array<double, 3> weights_about(Vec3 p, const Triangle& triangle) {
  double largest = 0.0;
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) {
    t[k] = triangle[k] - p;
    largest = std::max({largest, std::abs(t[k].x), std::abs(t[k].y), std::abs(t[k].z)});
  }
  const double scale = unit_scale(largest);
  for (Vec3& q : t) q = scale * q;
  return nearest_weights({}, t);
}

}  // namespace tact::narrowphase

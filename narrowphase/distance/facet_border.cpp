#include "narrowphase/distance/facet_border.h"

#include <algorithm>

#include "narrowphase/distance/short_ways.h"
#include "narrowphase/distance/signs.h"

namespace tact::narrowphase {

namespace {

constexpr double kSmallLength = 0x1p-400;  // the squares of shorter ones may vanish

bool certainly_positive(double value, double size_squared) {
  return value > 0.0 && certain_sign(value, size_squared) > 0;
}

Vec3 direction_or_zero(Vec3 v, double length) {
  if (length > kSmallLength) return (1.0 / length) * v;
  return v == Vec3{} ? Vec3{} : unit_vector(v);
}

}  // namespace

std::optional<Nearest> nearest_inside_edge(Vec3 v, Vec3 p, Vec3 q, const ScaledVertices& third, double limit) {
  const Vec3 edge = q - p;
  const double place = dot(v - p, edge), length = dot(edge, edge);
  if (!(place > 0.0 && place < length)) return {};
  const double t = place / length;
  // From the nearer end, so that the product is as short as can be.
  Vec3 way = t < 0.5 ? t * edge - (v - p) : (t - 1.0) * edge - (v - q);
  if (norm_squared(way) <= kSignRounding * kSignRounding * length) way = fine_way_to_line(v, p, q);
  const double distance = length_of(way);
  if (!(distance < limit)) return {};
  for (std::size_t i = 0; i < third.size(); ++i) {
    if (side_of_edge(v, p, q, third[i]) > 0) return {};
  }
  return Nearest{.normal = direction_or_zero(way, distance), .distance = distance, .weight = {1.0 - t, t}};
}

std::optional<Nearest> nearest_in_vertex(Vec3 v, Vec3 w, const ScaledVertices& neighbors, double limit) {
  const double distance = length_of(w - v);
  if (!(distance < limit)) return {};
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    if (sign_along(w, neighbors[i], w, v) > 0) return {};
  }
  return Nearest{.normal = direction_or_zero(w - v, distance), .distance = distance, .weight = {1.0}};
}

unsigned border_of(Vec3 v, const Vec3 (&corner)[3], double limit) {
  Vec3 away[3], side[3];
  double square[3], length[3], place[3];  // of `away`, of `side`; how far along the side, times its length
  for (int k = 0; k < 3; ++k) {
    away[k] = v - corner[k];
    side[k] = corner[(k + 1) % 3] - corner[k];
    square[k] = norm_squared(away[k]);
    length[k] = norm_squared(side[k]);
    place[k] = dot(away[k], side[k]);
  }
  const double most = limit * limit * (1.0 + 0x1p-40);
  unsigned left = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    const double back = -dot(away[k], side[last]);  // along the side to the last corner
    // In the corner: with the operations of nearest_in_vertex(), but for the root.
    if (square[k] <= most && !certainly_positive(place[k], square[k] * length[k]) &&
        !certainly_positive(back, square[k] * length[last]))
      left |= 8u << k;
    // Inside the edge: nearest_inside_edge() may count from its other end, so that what rounding moves is left.
    const double rounding = 0x1p-40 * (square[k] + length[k]);
    if (place[k] < -rounding || place[k] > length[k] + rounding) continue;
    const double apart = square[k] * length[k] - place[k] * place[k];  // squared distance times length
    if (apart > most * length[k] + 0x1p-40 * square[k] * length[k] + kVanishing) continue;
    const double inner = back * length[k] + dot(side[last], side[k]) * place[k];
    const double size_squared =
        length[k] * length[k] * std::max(square[k], square[next]) * std::max(length[last], length[next]);
    if (!certainly_positive(inner, 16.0 * size_squared)) left |= 1u << k;
  }
  return left;
}

}  // namespace tact::narrowphase

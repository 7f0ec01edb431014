#include "bench/rivals/near_distances.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/distance/edge_edge.h"
#include "narrowphase/distance/signs.h"
#include "narrowphase/distance/vertex_facet.h"
#include "narrowphase/numeric/double_double.h"

namespace tact::bench {

namespace {

using base::Vec3;
using narrowphase::certain_sign;
using narrowphase::kNearlyParallel;
using narrowphase::kSignRounding;
using narrowphase::kVanishing;

Vec3 plain_unit(Vec3 v, double length) {
  if (length > 0x1p-400) return (1.0 / length) * v;
  return v == Vec3{} ? Vec3{} : narrowphase::unit_vector(v);
}

// Where the lines of two edges are nearest, times the square of `across`.
struct PlainLines {
  Vec3 u, w, r, across;
  double square, size_squared;
  PlainLines(const EdgeEnds& e, const EdgeEnds& f)
      : u(e.q - e.p),
        w(f.q - f.p),
        r(f.p - e.p),
        across(cross(u, w)),
        square(norm_squared(across)),
        size_squared(norm_squared(u) * norm_squared(w)) {}
  double on_e() const { return dot(cross(r, w), across); }
  double on_f() const { return dot(cross(r, u), across); }
  bool leads(double way, Vec3 end, const ScaledVertices& third) const {
    for (std::size_t i = 0; i < third.size(); ++i) {
      const Vec3 to = third[i] - end;
      const double rise = way * dot(across, to);
      if (rise > 0.0 && rise > kSignRounding * std::sqrt(square) * norm(to)) return true;
    }
    return false;
  }
  // Of nearly parallel ones.
  bool certainly_beyond(double limit) const {
    const double length = norm_squared(u), width = norm_squared(w), between = norm_squared(r);
    const double begin = dot(r, u), end = begin + dot(w, u), rounding = 0x1p-40 * (length + width + between);
    if (std::max(begin, end) < -rounding || std::min(begin, end) > length + rounding) return true;
    constexpr double kTurned = 0x1p-7;
    const Vec3 aside = cross(r, u);
    if (norm_squared(aside) >
        limit * limit * length * (1.0 + kTurned) + square * (1.0 + 1.0 / kTurned) + 0x1p-40 * (between * length))
      return true;
    const auto is_beside = [&](double place, double on_other) {
      const double size = between * on_other * size_squared;
      return certain_sign(place, size) < 0 ||
             certain_sign(square - place, 2.0 * (size + size_squared * size_squared)) < 0;
    };
    return is_beside(on_e(), width) || is_beside(dot(aside, across), length);
  }
};

}  // namespace

std::optional<Nearest> plain_nearest_inside_facet(Vec3 v, const Vec3 (&corner)[3], double limit) {
  const Vec3 normal = narrowphase::moderate_cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double square = norm_squared(normal), along = dot(normal, v - corner[0]);
  if (square == 0.0 || along * along > limit * limit * square * (1.0 + 0x1p-40)) return {};
  if (along == 0.0 && (v == corner[0] || v == corner[1] || v == corner[2])) return {};
  for (int k = 0; k < 3; ++k) {
    if (narrowphase::side_of_edge(v, corner[(k + 1) % 3], corner[(k + 2) % 3], corner[k]) <= 0) return {};
  }
  const double length = std::sqrt(square), height = along / length;
  if (!(std::abs(height) < limit)) return {};
  Nearest nearest{.normal = (height < 0.0 ? 1.0 / length : -1.0 / length) * normal, .distance = std::abs(height)};
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = corner[(k + 1) % 3], q = corner[(k + 2) % 3];
    nearest.weight[k] = std::max(0.0, dot(normal, cross(q - p, v - p)));
    sum += nearest.weight[k];
  }
  if (!(sum > kVanishing)) return narrowphase::nearest_inside_facet(v, corner, limit);
  for (double& weight : nearest.weight) weight /= sum;
  return nearest;
}

std::optional<Nearest> plain_nearest_inside_edge(Vec3 v, Vec3 p, Vec3 q, const ScaledVertices& third, double limit) {
  const Vec3 edge = q - p;
  const double place = dot(v - p, edge), length = dot(edge, edge);
  if (!(place > 0.0 && place < length)) return {};
  const double t = place / length;
  const Vec3 way = t < 0.5 ? t * edge - (v - p) : (t - 1.0) * edge - (v - q);
  const double distance = narrowphase::length_of(way);
  if (!(distance < limit)) return {};
  for (std::size_t i = 0; i < third.size(); ++i) {
    if (narrowphase::side_of_edge(v, p, q, third[i]) > 0) return {};
  }
  return Nearest{.normal = plain_unit(way, distance), .distance = distance, .weight = {1.0 - t, t}};
}

std::optional<Nearest> plain_nearest_in_vertex(Vec3 v, Vec3 w, const ScaledVertices& neighbors, double limit) {
  const double distance = narrowphase::length_of(w - v);
  if (!(distance < limit)) return {};
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    if (narrowphase::sign_along(w, neighbors[i], w, v) > 0) return {};
  }
  return Nearest{.normal = plain_unit(w - v, distance), .distance = distance, .weight = {1.0}};
}

std::optional<Nearest> plain_nearest_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                                   const ScaledVertices& third_f, double limit) {
  const PlainLines lines(e, f);
  const bool is_clear = lines.size_squared > kVanishing && lines.square > kNearlyParallel * lines.size_squared;
  if (!is_clear) {
    if (lines.size_squared > kVanishing && lines.certainly_beyond(limit)) return {};
    return narrowphase::nearest_between_edges(e, third_e, f, third_f, limit);
  }
  const double s = lines.on_e(), t = lines.on_f();
  if (!(s > 0.0 && s < lines.square && t > 0.0 && t < lines.square)) return {};
  const double length = std::sqrt(lines.square), distance = std::abs(dot(lines.across, lines.r) / length);
  if (!(distance < limit)) return {};
  const double of_e = s / lines.square, of_f = t / lines.square, first = dot(lines.across, lines.r) < 0.0 ? -1.0 : 1.0;
  for (const double way : {first, -first}) {
    if (!lines.leads(way, e.p, third_e) && !lines.leads(-way, f.p, third_f))
      return Nearest{.normal = (way / length) * lines.across,
                     .distance = distance,
                     .weight = {1.0 - of_f, of_f},
                     .first = {1.0 - of_e, of_e}};
    if (distance > 0.0) break;
  }
  return {};
}

}  // namespace tact::bench

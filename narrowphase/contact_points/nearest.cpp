#include "narrowphase/contact_points/nearest.h"

#include <algorithm>
#include <cmath>

namespace tact::narrowphase {

namespace {

// Bounds what a sign below loses in doubles, relative to the product of the lengths that are multiplied: 16 roundings
// of 2^-53 are in the longest of them, 256 leave room. Long doubles round 2048 times less.
constexpr double kRounding = kSignRounding, kWideRounding = kRounding / 2048;

template <class Real>
struct Vec {
  Real x, y, z;
  Vec(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
  explicit Vec(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};

template <class Real>
Real dot(const Vec<Real>& a, const Vec<Real>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <class Real>
Vec<Real> cross(const Vec<Real>& a, const Vec<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
struct Measured {
  Real value;
  Real size;  // of the products that it is a sum of
};

int sign_of(double value, double bound) { return value > bound ? 1 : value < -bound ? -1 : 0; }

// The sign of measure<Real>(), which holds a value and a size.
template <class Measure>
int sign(const Measure& measure) {
  const Measured<double> rough = measure(double{});
  const int rough_sign = sign_of(rough.value, kRounding * rough.size);
  if (rough_sign != 0 || rough.size == 0.0) return rough_sign;
  const Measured<long double> fine = measure(static_cast<long double>(0));
  return sign_of(static_cast<double>(fine.value), kWideRounding * static_cast<double>(fine.size));
}

// The sign of a value that is certain beyond kRounding times a size whose square is given: without a root.
int certain_sign(double value, double size_squared) {
  return value * value > kRounding * kRounding * size_squared ? (value > 0.0 ? 1 : -1) : 0;
}

// On which side of the edge from p to q is v, seen across the plane of the edge and `third`? 1 on that of `third`.
int side_of_edge(Vec3 v, Vec3 p, Vec3 q, Vec3 third) {
  const Vec3 along = q - p, away = v - p, across = third - p;
  const double square = norm_squared(along);
  const int certain = certain_sign(dot(away, across) * square - dot(across, along) * dot(away, along),
                                   square * square * (norm_squared(away) * norm_squared(across)));
  if (certain != 0) return certain;
  return sign([&]<class Real>(Real) -> Measured<Real> {
    const Vec<Real> from(p), edge = Vec<Real>(q) - from, to_v = Vec<Real>(v) - from, to_third = Vec<Real>(third) - from;
    const Real length = dot(edge, edge), x = dot(to_v, to_third), y = dot(to_third, edge), z = dot(to_v, edge);
    return {x * length - y * z, length * std::sqrt(dot(to_v, to_v) * dot(to_third, to_third))};
  });
}

// The sign of the dot product of b - a and d - c.
int along(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const int certain = certain_sign(dot(b - a, d - c), norm_squared(b - a) * norm_squared(d - c));
  if (certain != 0) return certain;
  return sign([&]<class Real>(Real) -> Measured<Real> {
    const Vec<Real> ab = Vec<Real>(b) - Vec<Real>(a), cd = Vec<Real>(d) - Vec<Real>(c);
    return {dot(ab, cd), std::sqrt(dot(ab, ab) * dot(cd, cd))};
  });
}

Vec3 direction_or_zero(Vec3 v, double length) { return length > 0.0 ? (1.0 / length) * v : Vec3{}; }

// The closest points of two lines, from one end of each.
template <class Real>
struct LinePair {
  Vec<Real> u, w, r;  // along e, along f, from e's first end to f's
  Vec<Real> across;
  Real s, t, square;  // places times `square`, which is that of |across|
  LinePair(const EdgeEnds& e, const EdgeEnds& f)
      : u(Vec<Real>(e.q) - Vec<Real>(e.p)),
        w(Vec<Real>(f.q) - Vec<Real>(f.p)),
        r(Vec<Real>(f.p) - Vec<Real>(e.p)),
        across(cross(u, w)),
        s(dot(cross(r, w), across)),
        t(dot(cross(r, u), across)),
        square(dot(across, across)) {}
  bool inside_both() const { return s > 0 && s < square && t > 0 && t < square; }
};

// Does a facet with one of these third vertices lead from `end` along `way`?
template <class Real>
bool leads_along(const Vec<Real>& way, Vec3 end, const ScaledVertices& third) {
  constexpr Real kBound = std::is_same_v<Real, double> ? Real{kRounding} : Real{kWideRounding};
  for (std::size_t i = 0; i < third.size(); ++i) {
    const Vec<Real> to = Vec<Real>(third[i]) - Vec<Real>(end);
    const Real rise = dot(way, to);
    // Most facets lead back, which takes no root to see.
    if (rise > 0 && rise > kBound * std::sqrt(dot(way, way)) * std::sqrt(dot(to, to))) return true;
  }
  return false;
}

// Where two edges are nearest, and how near.
struct EdgesApart {
  double s, t;  // places on either edge
  Vec3 normal;  // unit, the way that `across` shows
  double distance;
};

EdgesApart edges_apart(const LinePair<double>& lines) {
  const double length = std::sqrt(lines.square);
  return {lines.s / lines.square,
          lines.t / lines.square,
          {lines.across.x / length, lines.across.y / length, lines.across.z / length},
          std::abs(dot(lines.across, lines.r) / length)};
}

// Of edges that are nearly parallel rounding turns `across`, and moves the places far along the edges. The distance
// hardly changes along them, so it is measured from the place on e to its foot on f.
EdgesApart edges_apart(const LinePair<long double>& lines) {
  using Long3 = Vec<long double>;
  const long double s = lines.s / lines.square;
  const long double foot = (s * dot(lines.u, lines.w) - dot(lines.r, lines.w)) / dot(lines.w, lines.w);
  const long double t = std::clamp(foot, 0.0L, 1.0L);
  Long3 way(lines.r.x + t * lines.w.x - s * lines.u.x, lines.r.y + t * lines.w.y - s * lines.u.y,
            lines.r.z + t * lines.w.z - s * lines.u.z);
  const long double distance = std::sqrt(dot(way, way));
  // Lengths are near 1: a way so short has no direction of its own.
  if (!(distance > 0x1p-40L)) way = lines.across;
  const long double turn = dot(way, lines.across) < 0 ? -1 : 1, unit = turn / std::sqrt(dot(way, way));
  return {static_cast<double>(s),
          static_cast<double>(t),
          {static_cast<double>(unit * way.x), static_cast<double>(unit * way.y), static_cast<double>(unit * way.z)},
          static_cast<double>(distance)};
}

template <class Real>
std::optional<Nearest> between(const LinePair<Real>& lines, const EdgeEnds& e, const ScaledVertices& third_e,
                               const EdgeEnds& f, const ScaledVertices& third_f, double limit, EdgeSide side) {
  if (!lines.inside_both()) return {};
  const EdgesApart apart = edges_apart(lines);
  if (!(apart.distance < limit)) return {};
  const bool turned = (dot(lines.across, lines.r) < 0) == (side == EdgeSide::before);
  for (const bool back : {turned, !turned}) {
    const Vec<Real>& across = lines.across;
    const Vec<Real> opposite(-across.x, -across.y, -across.z);
    if (!leads_along(back ? opposite : across, e.p, third_e) && !leads_along(back ? across : opposite, f.p, third_f))
      return Nearest{.normal = back ? -apart.normal : apart.normal,
                     .distance = apart.distance,
                     .weight = {1.0 - apart.t, apart.t},
                     .first = {1.0 - apart.s, apart.s}};
    if (apart.distance > 0.0) break;  // edges that touch have no side yet
  }
  return {};
}

}  // namespace

std::optional<Nearest> nearest_inside_facet(Vec3 v, const Vec3 (&corner)[3], double limit) {
  const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double square = norm_squared(normal), along = dot(normal, v - corner[0]);
  // Most vertices are too far, or beside the facet: that needs no root.
  if (square == 0.0 || along * along > limit * limit * square * (1.0 + 0x1p-40)) return {};
  for (int k = 0; k < 3; ++k) {
    if (side_of_edge(v, corner[(k + 1) % 3], corner[(k + 2) % 3], corner[k]) <= 0) return {};
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
  for (double& weight : nearest.weight) weight /= sum;
  return nearest;
}

std::optional<Nearest> nearest_inside_edge(Vec3 v, Vec3 p, Vec3 q, const ScaledVertices& third, double limit) {
  const Vec3 edge = q - p;
  const double place = dot(v - p, edge), length = dot(edge, edge);
  if (!(place > 0.0 && place < length)) return {};
  const double t = place / length;
  // From the nearer end, so that the product is as short as can be.
  const Vec3 way = t < 0.5 ? t * edge - (v - p) : (t - 1.0) * edge - (v - q);
  const double distance = norm(way);
  if (!(distance < limit)) return {};
  for (std::size_t i = 0; i < third.size(); ++i) {
    if (side_of_edge(v, p, q, third[i]) > 0) return {};
  }
  return Nearest{.normal = direction_or_zero(way, distance), .distance = distance, .weight = {1.0 - t, t}};
}

std::optional<Nearest> nearest_in_vertex(Vec3 v, Vec3 w, const ScaledVertices& neighbors, double limit) {
  const double distance = norm(w - v);
  if (!(distance < limit)) return {};
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    if (along(w, neighbors[i], w, v) > 0) return {};
  }
  return Nearest{.normal = direction_or_zero(w - v, distance), .distance = distance, .weight = {1.0}};
}

namespace {

std::optional<Nearest> between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                     const ScaledVertices& third_f, double limit, EdgeSide side) {
  const LinePair<double> rough(e, f);
  // What is nearly parallel is looked at in long doubles. The kernels near_edges() and edges_beyond() ask the same.
  if (rough.square > kNearlyParallel * (dot(rough.u, rough.u) * dot(rough.w, rough.w)))
    return between(rough, e, third_e, f, third_f, limit, side);
  const LinePair<long double> fine(e, f);
  if (!(fine.square > 0)) return {};
  return between(fine, e, third_e, f, third_f, limit, side);
}

}  // namespace

std::optional<Nearest> nearest_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                             const ScaledVertices& third_f, double limit) {
  return between_edges(e, third_e, f, third_f, limit, EdgeSide::before);
}

std::optional<Nearest> crossing_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                              const ScaledVertices& third_f, double limit) {
  return between_edges(e, third_e, f, third_f, limit, EdgeSide::passed);
}

}  // namespace tact::narrowphase

#include "narrowphase/distance/edge_edge.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "narrowphase/distance/short_ways.h"
#include "narrowphase/distance/signs.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

double head_of(double x) { return x; }
double head_of(DoubleDouble x) { return x.head; }

template <class Number>
NumberVector<Number> difference(Vec3 p, Vec3 q) {
  if constexpr (std::is_same_v<Number, double>) return {p.x - q.x, p.y - q.y, p.z - q.z};
  if constexpr (!std::is_same_v<Number, double>) return double_double_difference(p, q);
}

template <class Number>
double size_squared(const NumberVector<Number>& v) {
  return norm_squared(Vec3{head_of(v.x), head_of(v.y), head_of(v.z)});
}

// The lines of two edges, from one end of each.
template <class Number>
struct LinePair {
  NumberVector<Number> u, w, r;  // along e, along f, from e's first end to f's
  NumberVector<Number> across;
  Number square;        // of |across|
  double size_squared;  // of the product of |u| and |w|
  LinePair(const NumberVector<Number>& along_e, const NumberVector<Number>& along_f,
           const NumberVector<Number>& between, const NumberVector<Number>& across_both)
      : u(along_e),
        w(along_f),
        r(between),
        across(across_both),
        square(dot(across, across)),
        size_squared(narrowphase::size_squared(u) * narrowphase::size_squared(w)) {}
  // Where the lines are nearest, times `square`.
  Number on_e() const { return dot(cross(r, w), across); }
  Number on_f() const { return dot(cross(r, u), across); }
  // Bounds what rounding leaves of `across`.
  double rounding() const {
    return std::is_same_v<Number, double> ? kSignRounding * std::sqrt(head_of(square))
                                          : kFineRounding * std::sqrt(size_squared);
  }
  // Whether a facet with one of these third vertices leads from `end` along the way, which is `across` times a sign.
  bool leads(double way, Vec3 end, const ScaledVertices& third) const {
    for (std::size_t i = 0; i < third.size(); ++i) {
      const NumberVector<Number> to = difference<Number>(third[i], end);
      const double rise = way * head_of(dot(across, to));
      // Most facets lead back, which takes no root to see.
      if (rise > 0.0 && rise > rounding() * std::sqrt(narrowphase::size_squared(to))) return true;
    }
    return false;
  }
};

// Edges and the facets at them.
struct Sides {
  const EdgeEnds &e, &f;
  const ScaledVertices &third_e, &third_f;
  EdgeSide side;

  // The point with the side that the facets leave to it. Before: with `across` as its normal, along which f is as high
  // above e as `height`.
  template <class Number>
  std::optional<Nearest> operator()(const LinePair<Number>& lines, double height, const Nearest& nearest) const {
    const bool turned = (height < 0.0) == (side == EdgeSide::before);
    const double first = turned ? -1.0 : 1.0;
    for (const double way : {first, -first}) {
      if (!lines.leads(way, e.p, third_e) && !lines.leads(-way, f.p, third_f)) {
        Nearest found = nearest;
        found.normal = way * nearest.normal;
        return found;
      }
      if (nearest.distance > 0.0) break;  // edges that touch have no side yet
    }
    return {};
  }
};

// Whether nearly parallel lines are certainly not nearest inside both edges, or not nearer than `limit`. There the way
// from one to the other is across both, so that, seen along e, the edges overlap; and f is at least as far from the
// line of e as its first end, but for what it turns away: |r × u| - |w × u|, over |u|.
bool certainly_none(const LinePair<double>& lines, double limit) {
  const double length = size_squared(lines.u), width = size_squared(lines.w), between = size_squared(lines.r);
  const double begin = dot(lines.r, lines.u), end = begin + dot(lines.w, lines.u);
  const double rounding = 0x1p-40 * (length + width + between);
  if (std::max(begin, end) < -rounding || std::min(begin, end) > length + rounding) return true;
  const NumberVector<double> aside = cross(lines.r, lines.u);
  constexpr double kTurned = 0x1p-7;  // (a + b)² is at most a² (1 + k) + b² (1 + 1 / k)
  if (size_squared(aside) >
      limit * limit * length * (1.0 + kTurned) + lines.square * (1.0 + 1.0 / kTurned) + 0x1p-40 * (between * length))
    return true;
  const auto is_beside = [&](double place, double on_other) {
    const double size = between * on_other * lines.size_squared;
    return certain_sign(place, size) < 0 ||
           certain_sign(lines.square - place, 2.0 * (size + lines.size_squared * lines.size_squared)) < 0;
  };
  return is_beside(lines.on_e(), width) || is_beside(dot(aside, lines.across), length);
}

// Edges clearly not parallel. What is found goes through finish(lines, height, nearest).
template <class Finish>
std::optional<Nearest> between(const LinePair<double>& lines, const EdgeEnds& e, const EdgeEnds& f, double limit,
                               const Finish& finish) {
  const double s = lines.on_e(), t = lines.on_f();
  if (!(s > 0.0 && s < lines.square && t > 0.0 && t < lines.square)) return {};
  const double length = std::sqrt(lines.square), along = dot(lines.across, lines.r);
  const bool is_told =
      tells_height(along, lines.square, size_squared(lines.u), size_squared(lines.w), size_squared(lines.r));
  const double height = is_told ? along / length : fine_height(e.p, e.q, f.p, f.q, e.p, f.p);
  const double distance = std::abs(height);
  if (!(distance < limit)) return {};
  const double of_e = s / lines.square, of_f = t / lines.square;
  return finish(lines, height,
                Nearest{.normal = {lines.across.x / length, lines.across.y / length, lines.across.z / length},
                        .distance = distance,
                        .weight = {1.0 - of_f, of_f},
                        .first = {1.0 - of_e, of_e}});
}

// Nearly parallel edges, or such short ones that products vanish, whose lengths are scaled to near 1 by two powers of
// two. Their distance hardly changes along them, so it is measured from the place on e to its foot on f. Where
// double-doubles do not tell that the place is inside both, at an end or between lines turned by less than some 2^-45,
// there is none: points of the ends are near.
template <class Finish>
std::optional<Nearest> fine_between(const LinePair<DoubleDouble>& lines, double scale_e, double scale_f, double limit,
                                    const Finish& finish) {
  const double rounding = lines.rounding();
  const auto is_inside = [&](DoubleDouble place, double scale, double on_other) {
    const double lost = rounding * std::sqrt(size_squared(lines.r) * on_other);
    return place.head > lost &&
           (lines.square - scaled(place, scale)).head > scale * lost + rounding * std::sqrt(lines.size_squared);
  };
  const DoubleDouble place = lines.on_e(), width = dot(lines.w, lines.w);
  if (!is_inside(place, scale_e, width.head) || !is_inside(lines.on_f(), scale_f, size_squared(lines.u))) return {};
  const DoubleDouble s = place / lines.square;
  DoubleDouble t = (s * dot(lines.u, lines.w) - dot(lines.r, lines.w)) / width;
  if (t.head < 0.0) t = {};
  if (scale_f * t.head > 1.0) t = {1.0 / scale_f};
  DoubleDoubleVec3 way = (lines.r + t * lines.w) - s * lines.u;
  double distance = square_root(dot(way, way)).head, height = dot(lines.across, lines.r).head;
  if (!(distance > kFineRounding)) distance = height = 0.0;
  if (!(distance < limit)) return {};
  // A way so short has no direction of its own: lengths are near 1.
  if (!(distance > 0x1p-40)) way = lines.across;
  if (dot(way, lines.across).head < 0.0) way = -way;
  const DoubleDouble length = square_root(dot(way, way)), one{1.0}, of_e = scaled(s, scale_e),
                     of_f = scaled(t, scale_f);
  return finish(lines, height,
                Nearest{.normal = heads({way.x / length, way.y / length, way.z / length}),
                        .distance = distance,
                        .weight = {(one - of_f).head, of_f.head},
                        .first = {(one - of_e).head, of_e.head}});
}

double scale_of(const NumberVector<double>& v) {
  return unit_scale(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

// The kernels near_edges(), close_edges() and edges_beyond() tell nearly parallel edges by the same operations.
template <class Finish>
std::optional<Nearest> between_edges(const EdgeEnds& e, const EdgeEnds& f, double limit, const Finish& finish) {
  const NumberVector<double> along_e = difference<double>(e.q, e.p), along_f = difference<double>(f.q, f.p);
  const LinePair<double> rough(along_e, along_f, difference<double>(f.p, e.p), cross(along_e, along_f));
  if (rough.size_squared > kVanishing) {
    if (rough.square > kNearlyParallel * rough.size_squared) return between(rough, e, f, limit, finish);
    if (certainly_none(rough, limit)) return {};
  }
  const double scale_e = scale_of(rough.u), scale_f = scale_of(rough.w);
  const DoubleDoubleVec3 u = scaled(double_double_difference(e.q, e.p), scale_e),
                         w = scaled(double_double_difference(f.q, f.p), scale_f), across = cross(u, w);
  const bool parallel = size_squared(across) <= kFineRounding * kFineRounding * (size_squared(u) * size_squared(w));
  if (parallel) return {};
  const LinePair<DoubleDouble> fine(u, w, double_double_difference(f.p, e.p), across);
  return fine_between(fine, scale_e, scale_f, limit, finish);
}

}  // namespace

std::optional<Nearest> nearest_between_edges(const EdgeEnds& e, const ScaledVertices& third_e, const EdgeEnds& f,
                                             const ScaledVertices& third_f, double limit, EdgeSide side) {
  return between_edges(e, f, limit, Sides{e, f, third_e, third_f, side});
}

std::optional<Nearest> nearest_inside_edges(const EdgeEnds& e, const EdgeEnds& f, double limit) {
  return between_edges(e, f, limit, [](const auto&, double, const Nearest& nearest) { return std::optional(nearest); });
}

}  // namespace tact::narrowphase

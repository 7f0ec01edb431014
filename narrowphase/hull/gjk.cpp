#include "narrowphase/hull/gjk.h"

#include <algorithm>

#include "narrowphase/distance/simplex.h"

namespace tact::narrowphase {

namespace {

constexpr double kRoundingGap = 16.0 * 0x1p-52;

class GjkSearch {
 public:
  GjkSearch(const MinkowskiDifference& m, Vec3 point) : m_(m), point_(point) {}

  void start(const GjkSimplex& simplex) {
    for (int i = 0; i < simplex.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!holds(simplex.a[k], simplex.b[k])) append(m_.vertex(simplex.a[k], simplex.b[k]));
    }
    if (points_.count == 0) append(m_.support({1.0, 0.0, 0.0}));
    reduce();
    last_ = m_.vertex(simplex_.a[0], simplex_.b[0]);
  }

  GjkResult run(const GjkSettings& settings) {
    const double rounding = kRoundingGap * m_.size();
    while (!inside_ && result_.support_queries < settings.query_limit) {
      result_.distance = norm(closest_.point);
      closed_ = result_.distance <= rounding;
      if (closed_) break;
      const Vec3 toward = (-1.0 / result_.distance) * closest_.point;
      const MinkowskiVertex next = m_.support(toward, last_);
      last_ = next;
      ++result_.support_queries;
      const double height = -dot(toward, next.point - point_);
      result_.lower_bound = std::max(result_.lower_bound, height);
      const double gap = settings.tolerance * result_.distance + rounding;
      closed_ = result_.distance - result_.lower_bound <= gap;
      // Only where the last direction itself closes the bounds: it then separates M from the point by as much.
      if (result_.distance - height <= gap) break;
      // Without progress the simplex is thin and doubles have lost the nearest point: go on in triple-doubles.
      if (holds(next.a, next.b) || !advance(next)) {
        if (in_triple_) break;
        in_triple_ = true;
        reduce();
      }
    }
    return finish();
  }

 private:
  bool holds(int a, int b) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(simplex_.count); ++i) {
      if (simplex_.a[i] == a && simplex_.b[i] == b) return true;
    }
    return false;
  }

  void append(const MinkowskiVertex& v) {
    const auto i = static_cast<std::size_t>(simplex_.count++);
    simplex_.a[i] = v.a;
    simplex_.b[i] = v.b;
    points_.point[i] = v.point - point_;
    points_.count = simplex_.count;
  }

  // Adds a vertex if that brings the nearest point nearer.
  bool advance(const MinkowskiVertex& next) {
    const GjkSimplex simplex = simplex_;
    const SimplexPoints points = points_;
    const SimplexClosest closest = closest_;
    append(next);
    reduce();
    if (inside_ || closest_.is_nearer_than(closest)) return true;
    simplex_ = simplex;
    points_ = points;
    closest_ = closest;
    return false;
  }

  // Keeps the vertices that carry the nearest point.
  void reduce() {
    closest_ = in_triple_ ? simplex_closest_in_triple(points_) : simplex_closest(points_);
    inside_ = closest_.carrier_count == 4;
    for (std::size_t i = 0; i < static_cast<std::size_t>(closest_.carrier_count); ++i) {
      const auto from = static_cast<std::size_t>(closest_.carrier[i]);
      simplex_.a[i] = simplex_.a[from];
      simplex_.b[i] = simplex_.b[from];
      points_.point[i] = points_.point[from];
    }
    simplex_.count = points_.count = closest_.carrier_count;
  }

  GjkResult finish() {
    result_.simplex = simplex_;
    result_.offset = closest_.point;
    result_.weight = closest_.weight;
    result_.distance = norm(closest_.point);
    const double error = m_.height_error();
    // More digits do not know that the vertices of M are rounded.
    if (inside_ && (!in_triple_ || tetrahedron_holds_origin(points_))) {
      result_.status = GjkStatus::overlapping;
    } else if (result_.lower_bound > error) {
      result_.status = GjkStatus::apart;
    } else if (result_.distance <= 2.0 * (error + kRoundingGap * m_.size())) {
      result_.status = GjkStatus::touching;
    }
    result_.closed = closed_ || inside_;
    return result_;
  }

  const MinkowskiDifference& m_;
  Vec3 point_;
  GjkSimplex simplex_;
  SimplexPoints points_;
  SimplexClosest closest_;
  MinkowskiVertex last_;  // found, or of the start
  bool inside_ = false;
  bool closed_ = false;
  bool in_triple_ = false;
  GjkResult result_;
};

SimplexPoints vertices_of(const MinkowskiDifference& m, const GjkSimplex& simplex) {
  SimplexPoints points{.point = {}, .count = simplex.count};
  for (std::size_t i = 0; i < static_cast<std::size_t>(simplex.count); ++i)
    points.point[i] = m.vertex(simplex.a[i], simplex.b[i]).point;
  return points;
}

}  // namespace

bool holds_origin(const MinkowskiDifference& m, const GjkSimplex& simplex) {
  return simplex.count == 4 && tetrahedron_holds_origin(vertices_of(m, simplex));
}

ClosestPoints closest_points(const MinkowskiDifference& m, const GjkResult& result) {
  const GjkSimplex& simplex = result.simplex;
  const std::array<double, 4> weight = simplex.count < 4 ? result.weight : origin_weights(vertices_of(m, simplex));
  ClosestPoints closest;
  for (std::size_t i = 0; i < static_cast<std::size_t>(simplex.count); ++i) {
    closest.a = closest.a + weight[i] * (m.a().position(simplex.a[i]) - m.origin());
    closest.b = closest.b + weight[i] * (m.b().position(simplex.b[i]) - m.origin());
  }
  return {closest.a + m.origin(), closest.b + m.origin()};
}

GjkResult gjk(const MinkowskiDifference& m, Vec3 point, const GjkSimplex& start, const GjkSettings& settings) {
  GjkSearch search(m, point);
  search.start(start);
  return search.run(settings);
}

}  // namespace tact::narrowphase

#include "narrowphase/contact_direction.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "narrowphase/minkowski_face.h"

namespace tact::narrowphase {

namespace {

// The shift beyond w(n), relative to the size of M. Small converges in fewer iterations; tiny makes the gap, and so the
// direction between the closest points, ill-conditioned.
constexpr double kShift = 1e-3;
// How far a vertex may lie below the supporting plane and still belong to its face, in roundings of a height.
constexpr double kFaceTolerance = 4.0;
// A face is trusted to have a normal if its vertices span at least this sine.
constexpr double kSmallestSine = 1e-7;

// The normal of the face of M that a simplex spans, on the side of `toward`; nothing if it spans none, or one too thin.
// Sides are taken from the bodies, not from points of M, so that only differences of vertices are rounded.
std::optional<Vec3> face_normal(const MinkowskiDifference& m, const GjkSimplex& s, Vec3 toward) {
  if (s.count < 3) return std::nullopt;
  const auto side = [&](std::size_t i, std::size_t j) {
    return m.scale() * ((m.a().position(s.a[j]) - m.a().position(s.a[i])) - (m.b().position(s.b[j]) - m.b().position(s.b[i])));
  };
  const Vec3 e = side(0, 1), f = side(0, 2), g = side(1, 2);
  // The two shortest sides give the normal with the least rounding.
  const double ee = norm_squared(e), ff = norm_squared(f), gg = norm_squared(g);
  const bool drop_e = ee >= ff && ee >= gg, drop_f = !drop_e && ff >= gg;
  const Vec3 p = drop_e ? f : e, q = drop_f || drop_e ? g : f;
  const Vec3 n = cross(p, q);
  if (!(norm(n) > kSmallestSine * norm(p) * norm(q))) return std::nullopt;
  return normalized(dot(n, toward) < 0.0 ? -n : n);
}

class Search {
 public:
  Search(const MinkowskiDifference& m, const DirectionSettings& settings)
      : m_(m), settings_(settings), tolerance_(kFaceTolerance * m.height_error()) {}

  ContactDirection run(Vec3 start, const GjkSimplex& face) {
    turn_to(normalized(start));
    if (const auto kept = face_normal(m_, face, start); kept && dot(*kept, start) > 0.0 && supports(*kept, face)) {
      const ContactDirection before = best_;
      turn_to(*kept);
      best_.face = face;
      if (foot_in(face) || foot_in_supported_face()) return best_;
      if (before.height < best_.height) turn_to(before.n);
    }
    while (!done()) iterate();
    return best_;
  }

 private:
  bool done() {
    if (finished_ || best_.height < -m_.height_error()) return true;
    if (best_.iterations < settings_.iteration_limit) return false;
    best_.limit_reached = true;
    return true;
  }

  void turn_to(Vec3 n) {
    best_.n = n;
    top_ = support(n);
    best_.height = dot(n, top_.point);
  }

  MinkowskiVertex support(Vec3 n) {
    ++best_.support_queries;
    return m_.support(n);
  }

  // One shifted call of GJK, then the face that it ended on.
  void iterate() {
    ++best_.iterations;
    const Vec3 n = best_.n;
    const double height = best_.height;
    const Vec3 shifted = (height + kShift * std::max(height, m_.size())) * n;
    GjkSimplex seed;
    seed.a[0] = top_.a;
    seed.b[0] = top_.b;
    seed.count = 1;
    const GjkResult nearest = gjk(m_, shifted, best_.face.count > 0 ? best_.face : seed, settings_.gjk);
    best_.support_queries += nearest.support_queries;
    best_.limit_reached = nearest.status == GjkStatus::limit_reached;
    best_.face = nearest.simplex;
    if (nearest.distance > 0.0) turn_to((-1.0 / nearest.distance) * nearest.offset);
    if (const auto normal = face_normal(m_, nearest.simplex, best_.n); normal && supports(*normal, nearest.simplex)) {
      turn_to(*normal);
    }
    if (best_.height > height) {  // by rounding alone: w never increases
      turn_to(n);
    }
    if (nearest.simplex.count == 3 && foot_in(nearest.simplex)) {
      finished_ = true;
    } else if (foot_in_supported_face() || !(best_.height < height - tolerance_)) {
      leave_or_finish();
    }
  }

  // Does no vertex of M lie beyond the face?
  bool supports(Vec3 n, const GjkSimplex& face) {
    const double plane = dot(n, m_.vertex(face.a[0], face.b[0]).point);
    return dot(n, support(n).point) <= plane + tolerance_;
  }

  bool foot_in(const GjkSimplex& face) {
    FaceFeatures features;
    for (std::size_t i = 0; i < static_cast<std::size_t>(face.count); ++i) {
      features.a.push_back(face.a[i]);
      features.b.push_back(face.b[i]);
    }
    const FacePolygon polygon = face_polygon(m_, features, best_.n);
    return polygon.corner.size() > 2 && place_of_foot(polygon).margin > tolerance_;
  }

  bool foot_in_supported_face() {
    polygon_ = face_polygon(m_, supporting_features(m_, best_.n, tolerance_), best_.n);
    place_ = place_of_foot(polygon_);
    return polygon_.corner.size() > 2 ? place_.margin > tolerance_ : place_.margin > -tolerance_;
  }

  // The direction repeats. In the inside of a face it is a minimum; so is any direction with w = 0. Otherwise the foot
  // lies on an edge or a corner: turn to an adjacent face if that is lower.
  void leave_or_finish() {
    finished_ = true;
    if (best_.height <= tolerance_) return;
    if (polygon_.corner.size() > 2 && place_.margin > tolerance_) return;
    const std::optional<Vec3> lower = lowest_adjacent();
    if (!lower) return;
    best_.face = {};
    turn_to(*lower);
    finished_ = false;
    if (foot_in_supported_face() && polygon_.corner.size() > 2) finished_ = true;
  }

  std::optional<Vec3> lowest_adjacent() {
    std::optional<Vec3> lowest;
    double height = best_.height - tolerance_;
    for (const Vec3 t : tangents()) {
      const Vec3 turned = turned_to_next_face(m_, best_.n, top_.point, t, tolerance_);
      const double w = dot(turned, support(turned).point);
      if (w < height) {
        height = w;
        lowest = turned;
      }
    }
    return lowest;
  }

  // Across the side of the face that the foot is on; both ways from an edge; four ways from a corner.
  std::vector<Vec3> tangents() const {
    const auto in_space = [&](double x, double y) { return normalized(x * polygon_.u + y * polygon_.v); };
    const std::vector<Point2>& c = polygon_.corner;
    if (c.size() == 1) return {polygon_.u, -polygon_.u, polygon_.v, -polygon_.v};
    const auto i = static_cast<std::size_t>(place_.side);
    const Point2 from = c[i], to = c[(i + 1) % c.size()];
    const Vec3 outward = in_space(to.y - from.y, from.x - to.x);
    if (c.size() == 2) return {outward, -outward};
    return {outward};
  }

  const MinkowskiDifference& m_;
  const DirectionSettings& settings_;
  double tolerance_;
  ContactDirection best_;
  MinkowskiVertex top_;
  FacePolygon polygon_;
  FootPlace place_;
  bool finished_ = false;
};

}  // namespace

ContactDirection contact_direction(const MinkowskiDifference& m, Vec3 start, const GjkSimplex& face,
                                   const DirectionSettings& settings) {
  return Search(m, settings).run(start, face);
}

}  // namespace tact::narrowphase

#include "narrowphase/contact_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "narrowphase/frame.h"
#include "narrowphase/minkowski_face.h"
#include "narrowphase/wide_vec3.h"

namespace tact::narrowphase {

namespace {

// The shift beyond w(n), relative to the size of M. Small converges in fewer iterations; tiny makes the gap, and so the
// direction between the closest points, ill-conditioned. Where M is rounded with a radius far below the shift, as with
// rods, an iteration turns n by the ratio of the two only: so the shift shrinks with every iteration.
constexpr double kShift = 1e-3;
constexpr double kShrink = 0.25;
constexpr double kSmallestShift = 1e-12;
// How far a vertex may lie below the supporting plane and still belong to its face, in roundings of a height.
constexpr double kFaceTolerance = 4.0;

// The normal of the face of M that a simplex spans, on the side of `toward`; nothing if it spans none. Sides are taken
// from the bodies, not from points of M, and twice as wide as doubles: a thin face has a normal as good as any.
std::optional<Vec3> face_normal(const MinkowskiDifference& m, const GjkSimplex& s, Vec3 toward) {
  if (s.count < 3) return std::nullopt;
  const auto side = [&](std::size_t i, std::size_t j) {
    const auto point = [&](const ClusteredMesh& mesh, int vertex) { return m.scale() * mesh.position(vertex); };
    return wide_difference(point(m.a(), s.a[j]), point(m.a(), s.a[i])) -
           wide_difference(point(m.b(), s.b[j]), point(m.b(), s.b[i]));
  };
  const Vec3 n = wide_cross(side(0, 1), side(0, 2));
  if (n == Vec3{}) return std::nullopt;
  const Vec3 unit = unit_vector(n);
  return dot(unit, toward) < 0.0 ? -unit : unit;
}

class Search {
 public:
  Search(const MinkowskiDifference& m, const DirectionSettings& settings, FaceFinder& faces)
      : m_(m), settings_(settings), faces_(faces), tolerance_(kFaceTolerance * m.height_error()) {}

  ContactDirection run(Vec3 start, const GjkSimplex& face) {
    start = normalized(start);
    around_.count = std::min(1 + face.count, 4);
    std::copy_n(face.a.begin(), 3, around_.a.begin() + 1);
    std::copy_n(face.b.begin(), 3, around_.b.begin() + 1);
    if (!stay_on(face, start)) {
      while (!done()) iterate();
    }
    return best_;
  }

 private:
  bool done() {
    if (finished_ || best_.height < -m_.height_error()) return true;
    best_.limit_reached = best_.iterations >= settings_.iteration_limit;
    return best_.limit_reached;
  }

  void set_top(const MinkowskiVertex& top) {
    top_ = top;
    around_.a[0] = top.a;
    around_.b[0] = top.b;
  }

  void turn_to(Vec3 n) {
    best_.n = n;
    set_top(support(n));
    best_.height = dot(n, top_.point);
    best_.top_a = top_.a;
    best_.top_b = top_.b;
  }

  MinkowskiVertex support(Vec3 n) {
    ++best_.support_queries;
    return m_.support(n, top_);
  }

  // Does the last step's face still hold the foot? If not, goes on from the lower of `start` and what was tried.
  bool stay_on(const GjkSimplex& face, Vec3 start) {
    const std::optional<Vec3> n = face_normal(m_, face, start);
    if (!n || !(dot(*n, start) > 0.0)) {
      turn_to(start);
      finished_ = std::abs(best_.height) <= tolerance_;  // where w = 0 every direction is a minimum
      return finished_;
    }
    top_ = m_.vertex(face.a[0], face.b[0]);
    turn_to(*n);
    if (supported_by(face)) {
      best_.face = face;
      settle(face);
      if (finished_) return true;
    }
    const ContactDirection tried = best_;
    const MinkowskiVertex top = top_;
    turn_to(start);
    if (best_.height < tried.height) return false;
    const int queries = best_.support_queries;
    best_ = tried;
    best_.support_queries = queries;
    set_top(top);
    return false;
  }

  // One shifted call of GJK, then the face that it ended on.
  void iterate() {
    ++best_.iterations;
    const Vec3 n = best_.n;
    const double height = best_.height;
    const Vec3 shifted = (height + shift_ * std::max(height, m_.size())) * n;
    shift_ = std::max(kShrink * shift_, kSmallestShift);
    const GjkResult nearest = gjk(m_, shifted, best_.face.count > 0 ? best_.face : around_, settings_.gjk);
    best_.support_queries += nearest.support_queries;
    best_.face = nearest.simplex;
    const Vec3 between = nearest.distance > 0.0 ? (-1.0 / nearest.distance) * nearest.offset : n;
    const std::optional<Vec3> normal = face_normal(m_, nearest.simplex, between);
    if (normal) turn_to(*normal);
    bool on_face = normal && supported_by(nearest.simplex);
    if (!on_face) turn_to(between);
    if (best_.height > height) {  // by rounding alone: w never increases
      turn_to(n);
      on_face = false;
    }
    settle(on_face ? nearest.simplex : GjkSimplex{});
    if (!finished_ && !(best_.height < height - tolerance_)) leave_or_finish();
  }

  // Does no vertex of M lie beyond the face, whose normal is n?
  bool supported_by(const GjkSimplex& face) const {
    return best_.height <= dot(best_.n, m_.vertex(face.a[0], face.b[0]).point) + tolerance_;
  }

  // How near to the border of a face its foot is left alone. Nearer, a small turn over the border may lead to a lower
  // face: at a distance of r w(n) from the border, w is lower again beyond a turn of 2 r radians.
  double shallow() const { return std::max(tolerance_, kShallow * best_.height); }

  // Finishes if the foot lies well inside the face that n supports, of which `part` is known, or nothing.
  void settle(const GjkSimplex& part) {
    if (part.count == 3) {
      finished_ = holds_foot(part);
      if (finished_) return;
      const FacePolygon& polygon = faces_.spanned(m_, part, best_.n);
      finished_ = polygon.corner.size() > 2 && margin_of_foot(polygon) > shallow();
      if (finished_) return;
    }
    if (margin_of_face() >= -tolerance_) leave_or_finish();
  }

  // Does the foot lie well inside the triangle of three vertices of the face? The face may be larger.
  bool holds_foot(const GjkSimplex& part) const {
    Vec3 p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = m_.vertex(part.a[i], part.b[i]).point;
    const double side = dot(cross(p[1] - p[0], p[2] - p[0]), best_.n) < 0.0 ? -1.0 : 1.0;
    const double least = shallow() * shallow();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 from = p[i], along = p[(i + 1) % 3] - from;
      const double inside = side * dot(cross(from, along), best_.n);
      if (!(inside > 0.0 && inside * inside > least * norm_squared(along))) return false;
    }
    return true;
  }

  double margin_of_face() {
    polygon_ = &faces_.supported(m_, best_.n, tolerance_, top_);
    return margin_of_foot(*polygon_);
  }

  // The direction repeats, or the foot lies in a face. Goes over the border of the face where the foot is near it and
  // the other side is lower, and on from there; finishes where it is not. A foot on an edge or a corner is on the
  // border of faces. Where w = 0 every direction is a minimum.
  void leave_or_finish() {
    for (int i = 0; i < kWalkLimit; ++i) {
      const std::optional<Vec3> lower = best_.height > tolerance_ ? lowest_adjacent() : std::nullopt;
      finished_ = !lower;
      if (finished_) return;
      best_.face = {};
      turn_to(*lower);
      if (margin_of_face() < -tolerance_) return;
    }
    finished_ = true;
  }

  // The lowest of the faces across the sides that the foot is near to or beyond, both ways from an edge; around a
  // corner that the foot is near to or beyond. Nothing if none is lower.
  std::optional<Vec3> lowest_adjacent() {
    const std::vector<Point2>& c = polygon_->corner;
    const Vec3 u = polygon_->u, v = polygon_->v;
    const auto in_space = [&](Point2 p) { return p.x * u + p.y * v + best_.height * best_.n; };
    const auto is_near = [&](std::size_t side) {
      return c.size() == 2 || distance_from_side(*polygon_, side % c.size()) <= shallow();
    };
    Lowest lowest{best_.height - tolerance_, std::nullopt};
    std::array<Vec3, kNearCorners> near;
    std::size_t count = 0;
    if (c.size() == 1) near[count++] = in_space(c[0]);
    for (std::size_t i = 0; c.size() > 1 && i < c.size(); ++i) {
      if (!is_near(i)) continue;
      try_turn(in_space(c[i]), outward_of_side(*polygon_, i), lowest);
      if (is_near(i + 1) && count < kNearCorners) near[count++] = in_space(corner_at(c, i + 1));
    }
    for (std::size_t k = 0; k < count && !lowest.n; ++k) try_faces_around(near[k], lowest);
    return lowest.n;
  }

  struct Lowest {
    double height;
    std::optional<Vec3> n;
  };

  // Turns about the axis through a point of M in the supporting plane, to the next face; and by small angles where that
  // is not lower, for it may be a sliver with a lower face behind it.
  void try_turn(Vec3 axis_point, Vec3 towards, Lowest& lowest) {
    const double before = lowest.height;
    try_direction(turned_to_next_face(m_, best_.n, axis_point, towards, tolerance_, top_), lowest);
    for (double turn = kProbe; turn > kSmallestProbe && !(lowest.height < before); turn *= 0.1) {
      try_direction(normalized(best_.n + turn * towards), lowest);
    }
  }

  // Of the directions that a corner of M supports w is the lowest at the normal of a face around it. Goes around it one
  // way, and the other way too if the first comes to a right angle to n.
  void try_faces_around(Vec3 corner, Lowest& lowest) {
    if (!walk_around(corner, Way::counter_clockwise, lowest)) walk_around(corner, Way::clockwise, lowest);
  }

  enum class Way { counter_clockwise, clockwise };

  // Did the walk come back to the first face?
  bool walk_around(Vec3 corner, Way way, Lowest& lowest) {
    Vec3 n = best_.n;
    std::optional<Vec3> first;
    for (int i = 0; i < kFacesAround; ++i) {
      const FacePolygon& face = faces_.supported(m_, n, tolerance_, top_);
      const std::size_t sides = face.corner.size();
      if (sides == 1 && i > 0) return false;
      const std::size_t k = nearest_corner(face, {dot(face.u, corner), dot(face.v, corner)});
      const std::size_t side = way == Way::clockwise ? k + sides - 1 : k;
      const Vec3 outward = sides == 1 ? away_from(corner, n) : outward_of_side(face, side % sides);
      if (sides > 2) {
        if (first && norm(n - *first) <= kSameFace) return true;
        if (!first) first = n;
      }
      n = turned_to_next_face(m_, n, corner, outward, tolerance_, top_);
      try_direction(n, lowest);
      if (!(dot(n, best_.n) > 0.0)) return false;
    }
    return false;
  }

  // The tangent at n along which the height of the corner falls fastest.
  static Vec3 away_from(Vec3 corner, Vec3 n) {
    const Vec3 across = corner - dot(corner, n) * n;
    return across == Vec3{} ? frame_across(n).u : normalized(-across);
  }

  void try_direction(Vec3 n, Lowest& lowest) {
    const double w = dot(n, support(n).point);
    if (w < lowest.height) lowest = {w, n};
  }

  // 0.006: no turn by up to 0.01 leads lower, see shallow().
  static constexpr double kShallow = 0.006;
  static constexpr double kProbe = 0.01, kSmallestProbe = 0.5e-6;
  static constexpr std::size_t kNearCorners = 8;  // looked at, of a polygon
  static constexpr double kSameFace = 1e-13;
  static constexpr int kFacesAround = 256;
  static constexpr int kWalkLimit = 1000;

  const MinkowskiDifference& m_;
  const DirectionSettings& settings_;
  FaceFinder& faces_;
  double tolerance_;
  double shift_ = kShift;
  ContactDirection best_;
  MinkowskiVertex top_;
  GjkSimplex around_;                     // top_, and the vertices of the last step's face
  const FacePolygon* polygon_ = nullptr;  // of the face that n supports, once looked at
  bool finished_ = false;
};

}  // namespace

ContactDirection contact_direction(const MinkowskiDifference& m, Vec3 start, const GjkSimplex& face,
                                   const DirectionSettings& settings, FaceFinder& faces) {
  return Search(m, settings, faces).run(start, face);
}

}  // namespace tact::narrowphase

#include "narrowphase/contact_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
    if (!stay_near(face, start)) {
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

  // Is the foot in the last step's face still, or in one a few steps away? If not, goes on from the lower of `start`
  // and what was tried.
  bool stay_near(const GjkSimplex& face, Vec3 start) {
    std::optional<Vec3> n = face_normal(m_, face, start);
    if (!n || !(dot(*n, start) > 0.0)) {
      turn_to(start);
      finished_ = std::abs(best_.height) <= tolerance_;  // where w = 0 every direction is a minimum
      return finished_;
    }
    top_ = m_.vertex(face.a[0], face.b[0]);
    GjkSimplex part = face;
    double start_height = -std::numeric_limits<double>::infinity();  // of all vertices seen
    for (int step = 0; step < kSteps && n && dot(*n, start) > 0.0; ++step) {
      turn_to(*n);
      const CornerPoints corner = corner_points(part);
      for (const Vec3 p : {corner[0], corner[1], corner[2], top_.point})
        start_height = std::max(start_height, dot(start, p));
      std::optional<GjkSimplex> next;
      if (!supported_by(part)) {
        next = toward_foot(part, corner);
      } else {
        const FootSide side = side_of_foot(corner);
        if (side.distance >= -shallow()) {
          best_.face = part;
          settle(part);
          if (finished_ && best_.height <= start_height) return true;
          break;
        }
        next = across(part, corner, side.index);
      }
      if (!next) break;
      part = *next;
      n = face_normal(m_, part, best_.n);
    }
    return stay_below(start);
  }

  // Goes back to `start` if that is lower than what was found. Is the search finished?
  bool stay_below(Vec3 start) {
    const ContactDirection found = best_;
    const MinkowskiVertex top = top_;
    turn_to(start);
    if (best_.height < found.height) return finished_ = false;
    const int queries = best_.support_queries;
    best_ = found;
    best_.support_queries = queries;
    set_top(top);
    return finished_;
  }

  using CornerPoints = std::array<Vec3, 3>;
  CornerPoints corner_points(const GjkSimplex& part) const {
    const auto point = [&](std::size_t i) { return m_.vertex(part.a[i], part.b[i]).point; };
    return {point(0), point(1), point(2)};
  }

  // Twice the area that a side spans with the foot, seen against n, which the triangle may be turned to or away from.
  double span(Vec3 from, Vec3 to) const { return dot(cross(from, to - from), best_.n); }
  double turn_of(const CornerPoints& c) const {
    return dot(cross(c[1] - c[0], c[2] - c[0]), best_.n) < 0.0 ? -1.0 : 1.0;
  }

  // The side of a triangle that the foot is nearest to, or farthest beyond; distances are negative outside.
  struct FootSide {
    std::size_t index;  // from this corner to the next
    double distance;
  };
  FootSide side_of_foot(const CornerPoints& c) const {
    const double turn = turn_of(c);
    FootSide nearest{0, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 to = c[(i + 1) % 3];
      const double distance = turn * span(c[i], to) / norm(to - c[i]);
      if (!(distance >= nearest.distance)) nearest = {i, distance};
    }
    return nearest;
  }

  static GjkSimplex side_and(const GjkSimplex& part, std::size_t side, const MinkowskiVertex& v) {
    const std::size_t next = (side + 1) % 3;
    return {{part.a[side], part.a[next], v.a}, {part.b[side], part.b[next], v.b}, 3};
  }

  // The foot lies beyond a side of a face of M: the side, and the vertex that a plane turned about it by a fixed angle
  // finds, unless that is an end of the side.
  std::optional<GjkSimplex> across(const GjkSimplex& part, const CornerPoints& c, std::size_t side) {
    const Vec3 along = c[(side + 1) % 3] - c[side];
    const Vec3 outward = normalized(turn_of(c) * cross(along, best_.n));
    const MinkowskiVertex v = support(normalized(best_.n + kTilt * outward));
    const std::size_t next = (side + 1) % 3;
    if ((v.a == part.a[side] && v.b == part.b[side]) || (v.a == part.a[next] && v.b == part.b[next]))
      return std::nullopt;
    return side_and(part, side, v);
  }

  // A vertex lies above a triangle of M: of the triangles that it forms with a side, the one that holds the foot; or,
  // if none does, the one beyond the side that the foot lies beyond.
  std::optional<GjkSimplex> toward_foot(const GjkSimplex& part, const CornerPoints& c) const {
    const Vec3 v = top_.point;
    const double turn = turn_of(c);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 from = c[i], to = c[(i + 1) % 3];
      if (turn * span(from, to) >= 0.0 && turn * span(to, v) >= 0.0 && turn * span(v, from) >= 0.0)
        return side_and(part, i, top_);
    }
    const FootSide side = side_of_foot(c);
    if (side.distance >= 0.0) return std::nullopt;
    return side_and(part, side.index, top_);
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
  bool holds_foot(const GjkSimplex& part) const { return side_of_foot(corner_points(part)).distance > shallow(); }

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
  static constexpr int kSteps = 8;
  static constexpr double kTilt = 0.25;
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

#include "narrowphase/direction/contact_direction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "narrowphase/direction/adjacent_faces.h"
#include "narrowphase/direction/face_triangle.h"
#include "narrowphase/direction/minkowski_face.h"

namespace tact::narrowphase {

namespace {

// The shift beyond w(n), relative to the size of M. A small one converges in fewer iterations. A tiny one leaves a tiny
// gap, and makes the direction between the closest points ill-conditioned. Where M is rounded with a radius far below
// the shift, as with rods, an iteration turns n only by the ratio of the two: so the shift shrinks with every
// iteration.
constexpr double kShift = 1e-3;
constexpr double kShrink = 0.25;
constexpr double kSmallestShift = 1e-12;
// How far a vertex may lie below the supporting plane and still belong to its face, in roundings of a height.
constexpr double kFaceTolerance = 4.0;

class DirectionSearch {
 public:
  DirectionSearch(const MinkowskiDifference& m, const DirectionSettings& settings, FaceFinder& faces)
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
    const bool at_limit = best_.iterations >= settings_.iteration_limit;
    best_.limit_reached = best_.limit_reached || at_limit;
    return at_limit;
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

  // True if the projection is still in the last step's face, or in one a few steps away. If not, the search continues
  // from the lower of `start` and what was tried.
  bool stay_near(const GjkSimplex& face, Vec3 start) {
    std::optional<Vec3> n = face_normal(m_, face, start);
    if (!n || !(dot(*n, start) > 0.0)) {
      turn_to(start);
      finished_ = std::abs(best_.height) <= tolerance_;  // where w = 0 every direction is a minimum
      return finished_;
    }
    top_ = m_.vertex(face.a[0], face.b[0]);
    GjkSimplex part = face;
    double start_height = -std::numeric_limits<double>::infinity();  // w(start) is not below it
    for (int step = 0; step < kSteps && n && dot(*n, start) > 0.0; ++step) {
      turn_to(*n);
      const FaceTriangle triangle(m_, part, best_.n);
      for (const Vec3 p : triangle.corner()) start_height = std::max(start_height, dot(start, p));
      start_height = std::max(start_height, dot(start, top_.point));
      std::optional<GjkSimplex> next;
      if (!supported_by(part)) {
        next = triangle.toward_projection(top_);
      } else {
        const FaceTriangle::Side side = triangle.side_of_projection();
        if (side.distance >= -shallow()) {
          best_.face = part;
          finished_ = side.distance > shallow();
          if (!finished_) settle_around(part);
          if (finished_ && best_.height <= start_height) return true;
          break;
        }
        next = across(triangle, side.index);
      }
      if (!next) break;
      part = *next;
      n = face_normal(m_, part, best_.n);
    }
    return stay_below(start);
  }

  // Returns to `start` if that is lower than what was found. True if the search is finished.
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

  // The triangle across a side, beyond which the projection lies: the side, and the vertex that a plane turned about it
  // by a fixed angle supports. Nothing if that vertex is an end of the side.
  std::optional<GjkSimplex> across(const FaceTriangle& triangle, std::size_t side) {
    const Vec3 outward = triangle.outward(side);
    if (!(norm_squared(outward) > 0.0)) return std::nullopt;  // not a number: rounding has turned the side along n
    const MinkowskiVertex v = support(normalized(best_.n + kTilt * outward));
    if (triangle.is_end_of(side, v)) return std::nullopt;
    return triangle.side_and(side, v);
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
    best_.limit_reached = best_.limit_reached || !nearest.closed;
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

  // True if no vertex of M lies beyond the face, whose normal is n.
  bool supported_by(const GjkSimplex& face) const {
    return best_.height <= dot(best_.n, m_.vertex(face.a[0], face.b[0]).point) + tolerance_;
  }

  // The distance from the border of a face from which on a projection is well inside. Nearer to it, a small turn across
  // the border may lead lower: at a distance of r w(n), w is lower again beyond a turn of 2 r radians.
  double shallow() const { return std::max(tolerance_, kShallow * best_.height); }

  // Finishes if the projection lies well inside the face that n supports. `part` is a triangle of it, if one is known.
  // A triangle of the face is kept for the next step: `part`, or a wider one around the projection.
  void settle(const GjkSimplex& part) {
    finished_ = part.count == 3 && FaceTriangle(m_, part, best_.n).side_of_projection().distance > shallow();
    if (!finished_) settle_around(part);
  }

  // The same where the projection does not lie well inside `part`. The face may be larger.
  void settle_around(const GjkSimplex& part) {
    if (part.count == 3) {
      finish_inside(faces_.spanned(m_, part, best_.n));
      if (finished_) return;
    }
    if (margin_of_face() < -tolerance_) return;
    finish_inside(*polygon_);
    if (!finished_) leave_or_finish();
  }

  void finish_inside(const FacePolygon& polygon) {
    finished_ = polygon.corner.size() > 2 && margin_of_projection(polygon) > shallow();
    if (finished_) best_.face = faces_.around_projection(m_);
  }

  double margin_of_face() {
    polygon_ = &faces_.supported(m_, best_.n, tolerance_, top_);
    return margin_of_projection(*polygon_);
  }

  // The direction repeats, or the projection lies in a face. If the projection is near the border and the other side is
  // lower, crosses the border and goes on from there; else finishes. On an edge or a corner it is on the border of
  // faces. Where w = 0 every direction is a minimum.
  void leave_or_finish() {
    for (int i = 0; i < kWalkLimit; ++i) {
      const std::optional<Vec3> lower = best_.height > tolerance_ ? lowest_adjacent() : std::nullopt;
      finished_ = !lower;
      if (finished_) return;
      best_.face = {};
      turn_to(*lower);
      if (margin_of_face() < -tolerance_) return;
    }
    finished_ = best_.limit_reached = true;
  }

  std::optional<Vec3> lowest_adjacent() {
    AdjacentFaces adjacent(m_, faces_, tolerance_);
    const std::optional<Vec3> lowest =
        adjacent.lowest({.n = best_.n, .height = best_.height, .top = top_, .polygon = polygon_}, shallow());
    best_.support_queries += adjacent.support_queries();
    best_.limit_reached = best_.limit_reached || adjacent.limit_reached();
    return lowest;
  }

  // 0.006: no turn by up to 0.01 leads lower, see shallow().
  static constexpr double kShallow = 0.006;
  static constexpr int kSteps = 8;         // from the last step's face
  static constexpr double kTilt = 0.25;    // more than neighbouring faces are mostly turned, radians
  static constexpr int kWalkLimit = 1000;  // over borders

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
  return DirectionSearch(m, settings, faces).run(start, face);
}

}  // namespace tact::narrowphase

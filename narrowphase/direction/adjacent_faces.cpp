#include "narrowphase/direction/adjacent_faces.h"

#include <algorithm>
#include <array>

namespace tact::narrowphase {

namespace {

// Turns that are tried, in radians: none up to the largest may lead lower; at the smallest, a turn about an edge is
// within rounding.
constexpr double kProbe = 0.01, kSmallestProbe = 0.5e-6;
constexpr std::size_t kNearCorners = 8;  // looked at, of a polygon
constexpr int kFacesAround = 256;        // a corner, each way
constexpr int kFewestAround = 3;         // fewer are steps within rounding
constexpr double kSameFace = 1e-13;      // between unit normals

// The tangent along which the height of a polygon's only corner falls fastest; any if the projection is the corner.
Vec3 away_from_corner(const FacePolygon& polygon) {
  const Point2 c = polygon.corner[0];
  const double distance = length_of(c);
  return distance > 0.0 ? (-c.x / distance) * polygon.u - (c.y / distance) * polygon.v : polygon.u;
}

// A point of the face's plane.
Vec3 in_space(const SupportedFace& face, Point2 p) {
  return p.x * face.polygon->u + p.y * face.polygon->v + face.height * face.n;
}

}  // namespace

std::optional<Vec3> AdjacentFaces::lowest(const SupportedFace& face, double near) {
  const FacePolygon& polygon = *face.polygon;
  const std::size_t sides = polygon.corner.size();
  const auto is_near = [&](std::size_t side) {
    return sides == 2 || distance_from_side(polygon, side % sides) <= near;
  };
  near_ = near;
  lowest_height_ = face.height - tolerance_;
  lowest_.reset();
  limit_reached_ = false;
  std::array<Vec3, kNearCorners> corners;
  std::array<std::size_t, kNearCorners> places;  // in the polygon
  std::size_t count = 0;
  const auto add_corner = [&](std::size_t i) {
    const std::size_t place = i % sides;
    if (std::find(places.begin(), places.begin() + count, place) != places.begin() + count) return;
    if (count == kNearCorners) {
      limit_reached_ = true;
      return;
    }
    places[count] = place;
    corners[count++] = in_space(face, polygon.corner[place]);
  };
  if (sides == 1) add_corner(0);
  for (std::size_t i = 0; sides > 1 && i < sides; ++i) {
    if (!is_near(i)) continue;
    const bool is_flat = turn_over_side(face, i);
    if (is_flat) add_corner(i);
    if (is_flat || is_near(i + 1)) add_corner(i + 1);
  }
  // If the projection is outside of the polygon, which may be too small for its sides to have directions: the nearest
  // corner.
  if (count == 0 && margin_of_projection(polygon) < -tolerance_) add_corner(nearest_corner(polygon, {0.0, 0.0}));
  for (std::size_t k = 0; k < count && !lowest_; ++k) go_around(face, corners[k]);
  limit_reached_ = limit_reached_ && !lowest_;
  return lowest_;
}

// Turns about the axis along the side, to the next face; and by small angles where that is not lower, for
// it may be a sliver with a lower face behind it. Returns whether that face is turned so little that a small turn ends
// beyond it, where a corner of the side may be the highest.
bool AdjacentFaces::turn_over_side(const SupportedFace& face, std::size_t side) {
  const Vec3 axis_point = in_space(face, face.polygon->corner[side]), outward = outward_of_side(*face.polygon, side);
  if (!(norm_squared(outward) > 0.0)) return false;
  const double before = lowest_height_;
  const Vec3 next = turned_to_next_face(m_, face.n, axis_point, outward, tolerance_, face.top);
  try_direction(next, face.top);
  for (double turn = kProbe; turn > kSmallestProbe && !(lowest_height_ < before); turn *= 0.1) {
    try_direction(normalized(face.n + turn * outward), face.top);
  }
  return norm(next - face.n) < kProbe;
}

// Of the directions that a corner of M supports, w is the lowest at the normal of a face around it. Goes around it one
// way, and the other way too if the first comes to a right angle to n.
void AdjacentFaces::go_around(const SupportedFace& face, Vec3 corner) {
  if (!go_around(face, corner, Way::counter_clockwise)) go_around(face, corner, Way::clockwise);
}

// True if it came back to where it began.
bool AdjacentFaces::go_around(const SupportedFace& face, Vec3 corner, Way way) {
  Vec3 n = face.n;
  double height = face.height;
  std::optional<Vec3> first;
  for (int i = 0; i < kFacesAround; ++i) {
    const FacePolygon& polygon = faces_.supported(m_, n, tolerance_, face.top);
    const std::size_t sides = polygon.corner.size();
    if (sides == 1 && i > 0) return false;
    if (sides > 2) {
      if (i >= kFewestAround && first && norm(n - *first) <= kSameFace) return true;
      if (!first) first = n;
    }
    // A face as low as the first, and narrow: its sides are the ones to turn over.
    for (std::size_t s = 0; i > 0 && sides > 2 && s < sides && height <= face.height + tolerance_; ++s) {
      if (distance_from_side(polygon, s) <= near_) turn_over_side({n, height, face.top, &polygon}, s);
    }
    const std::size_t k = nearest_corner(polygon, {dot(polygon.u, corner), dot(polygon.v, corner)});
    const std::size_t side = (way == Way::clockwise ? k + sides - 1 : k) % sides;
    const Vec3 outward = sides == 1 ? away_from_corner(polygon) : outward_of_side(polygon, side);
    n = turned_to_next_face(m_, n, corner, outward, tolerance_, face.top);
    height = try_direction(n, face.top);
    if (!(dot(n, face.n) > 0.0)) return false;
  }
  return false;  // around needles rounding may lead in circles that miss the first face: what is there was looked at
}

// Returns w(n).
double AdjacentFaces::try_direction(Vec3 n, const MinkowskiVertex& near) {
  ++support_queries_;
  const double w = dot(n, m_.support(n, near).point);
  if (w < lowest_height_) {
    lowest_height_ = w;
    lowest_ = n;
  }
  return w;
}

}  // namespace tact::narrowphase
